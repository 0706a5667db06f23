# capfit-server in a small image: built in one stage, run as nobody from a second one.
#   docker build -t capfit .
#   docker run --rm -p 50051:50051 --read-only --cap-drop ALL capfit
# Without a registry: deploy/build_image.sh.
FROM docker.io/library/debian:bookworm-slim AS build
WORKDIR /src
COPY deploy/install_packages.sh deploy/
RUN deploy/install_packages.sh build
COPY . .
RUN cmake --preset release -DCAPFIT_BUILD_TESTS=OFF \
 && cmake --build --preset release --target capfit_server capfit_client_main \
 && strip build/release/server/capfit-server build/release/client/capfit

FROM docker.io/library/debian:bookworm-slim AS run
COPY deploy/install_packages.sh /tmp/install_packages.sh
RUN /tmp/install_packages.sh run \
 && rm -rf /tmp/install_packages.sh /var/lib/apt/lists/* /var/cache/apt/* /var/cache/debconf/* /usr/share/doc /usr/share/man /usr/share/locale
COPY --from=build /src/build/release/server/capfit-server /src/build/release/client/capfit /usr/local/bin/
USER 65534:65534
EXPOSE 50051
STOPSIGNAL SIGTERM
# Who reaches the container is decided by whoever publishes its port; any setting can be given in the
# same way, or as a flag (docs/security.md).
ENV CAPFIT_LISTEN=0.0.0.0:50051 CAPFIT_INSECURE_LISTEN=true
HEALTHCHECK --interval=10s --timeout=5s CMD ["capfit", "info", "--probe"]
ENTRYPOINT ["capfit-server"]
