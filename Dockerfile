# capfit-server in a small image: built in one stage, run as nobody from a second one.
#   docker build -t capfit .
#   docker run --rm -p 50051:50051 --read-only --cap-drop ALL capfit
FROM docker.io/library/debian:bookworm-slim AS build
WORKDIR /src
COPY deploy/install_packages.sh deploy/
RUN deploy/install_packages.sh build
COPY . .
RUN cmake --preset release -DCAPFIT_BUILD_TESTS=OFF \
 && cmake --build --preset release --target capfit_server capfit_client_main \
 && strip build/release/server/capfit-server build/release/client/capfit

FROM docker.io/library/debian:bookworm-slim
COPY deploy/install_packages.sh /tmp/install_packages.sh
RUN /tmp/install_packages.sh run && rm -rf /tmp/install_packages.sh /var/lib/apt/lists/*
COPY --from=build /src/build/release/server/capfit-server /src/build/release/client/capfit /usr/local/bin/
USER 65534:65534
EXPOSE 50051
STOPSIGNAL SIGTERM
ENTRYPOINT ["capfit-server"]
CMD ["--listen", "0.0.0.0:50051"]
