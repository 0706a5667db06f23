# cmake --install BUILD --prefix PREFIX [--component programs|library]
#
#   programs   bin/capfit, bin/capfit-server, share/doc/capfit/LICENSE
#   library    capfit::core and capfit::client for find_package(capfit), their headers below
#              include/capfit (so that "core/..." is nobody else's), share/capfit/proto
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckTypeSize)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/capfit")
set(header_dir "${CMAKE_INSTALL_INCLUDEDIR}/capfit")

# What Eigen aligns to follows from -march and is part of the binary interface of its types. Users
# compile with flags of their own, so they get the value of this build.
function(capfit_find_eigen_alignment result)
  get_target_property(CMAKE_REQUIRED_FLAGS capfit_flags INTERFACE_COMPILE_OPTIONS)
  list(FILTER CMAKE_REQUIRED_FLAGS INCLUDE REGEX "^-march=")
  set(CMAKE_REQUIRED_LIBRARIES Eigen3::Eigen)
  set(CMAKE_EXTRA_INCLUDE_FILES Eigen/Core)
  string(MAKE_C_IDENTIFIER "CAPFIT_EIGEN_ALIGNMENT_${CAPFIT_MARCH}" size)
  check_type_size("char[EIGEN_MAX_STATIC_ALIGN_BYTES]" ${size} LANGUAGE CXX)
  set(${result} "${${size}}" PARENT_SCOPE)
endfunction()
capfit_find_eigen_alignment(eigen_alignment)

# --- capfit::core: all rooms in one object (why: one_object.sh)
set(rooms base geometry formats mesh solid mannequin body character section circle capsule tighten
          refine coverage motion metrics skinning export pipeline)
set(room_files)
foreach(room IN LISTS rooms)
  list(APPEND room_files "$<TARGET_FILE:capfit_${room}>")
endforeach()
set(core_object "${CMAKE_CURRENT_BINARY_DIR}/capfit_core.o")
add_custom_command(OUTPUT "${core_object}"
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/one_object.sh" "${CMAKE_LINKER}" "${CMAKE_OBJCOPY}"
          "${CMAKE_NM}" "${core_object}" ${room_files}
  DEPENDS "${CMAKE_CURRENT_LIST_DIR}/one_object.sh" ${room_files}
  COMMENT "Linking the rooms of core/ to one object" VERBATIM)
add_library(capfit_whole_core STATIC "${core_object}")
set_source_files_properties("${core_object}" PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
set_target_properties(capfit_whole_core PROPERTIES
  LINKER_LANGUAGE CXX OUTPUT_NAME capfit_core EXPORT_NAME core)
target_compile_features(capfit_whole_core INTERFACE cxx_std_20)
target_compile_definitions(capfit_whole_core INTERFACE
  EIGEN_MAX_ALIGN_BYTES=${eigen_alignment} EIGEN_MAX_STATIC_ALIGN_BYTES=${eigen_alignment})
target_include_directories(capfit_whole_core INTERFACE "$<INSTALL_INTERFACE:${header_dir}>")
target_link_libraries(capfit_whole_core INTERFACE
  Eigen3::Eigen TBB::tbb absl::status absl::statusor absl::strings absl::str_format
  absl::flat_hash_map absl::flat_hash_set OpenMeshCore draco::draco meshoptimizer::meshoptimizer)

install(TARGETS capfit_whole_core EXPORT capfitCore COMPONENT library)
install(EXPORT capfitCore FILE capfitCoreTargets.cmake NAMESPACE capfit::
  DESTINATION "${package_dir}" COMPONENT library)
# (Headers about glTF and JSON, and of the half-edges while a mesh is mended, name libraries that
# are no part of the interface.)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/core" DESTINATION "${header_dir}" COMPONENT library
  FILES_MATCHING PATTERN "*.h" PATTERN "gl[bt]*_*.h" EXCLUDE
  PATTERN "json_text.h" EXCLUDE PATTERN "half_edge_mesh.h" EXCLUDE)
set(CAPFIT_INSTALLED_COMPONENTS core)

# --- capfit::client, the programs and the contract
if(CAPFIT_BUILD_SERVICE)
  list(APPEND CAPFIT_INSTALLED_COMPONENTS client)
  add_library(capfit_whole_client STATIC
    $<TARGET_OBJECTS:capfit_proto> $<TARGET_OBJECTS:capfit_wire> $<TARGET_OBJECTS:capfit_client>)
  set_target_properties(capfit_whole_client PROPERTIES LINKER_LANGUAGE CXX
    OUTPUT_NAME capfit_client EXPORT_NAME client
    ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  target_link_libraries(capfit_whole_client INTERFACE
    capfit_whole_core protobuf::libprotobuf gRPC::grpc++)
  install(TARGETS capfit_whole_client EXPORT capfitClient COMPONENT library)
  install(EXPORT capfitClient FILE capfitClientTargets.cmake NAMESPACE capfit::
    DESTINATION "${package_dir}" COMPONENT library)
  install(FILES "${PROJECT_SOURCE_DIR}/client/body_client.h"
                "${PROJECT_SOURCE_DIR}/client/connection.h"
                "${PROJECT_SOURCE_DIR}/client/retries.h" DESTINATION "${header_dir}/client"
    COMPONENT library)
  install(DIRECTORY "${PROJECT_BINARY_DIR}/proto/capfit" DESTINATION "${header_dir}"
    COMPONENT library FILES_MATCHING PATTERN "*.pb.h")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/proto/capfit"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/capfit/proto"
    COMPONENT library FILES_MATCHING PATTERN "*.proto")
  install(TARGETS capfit_client_main capfit_server COMPONENT programs)
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT programs)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/capfitConfig.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/capfitConfig.cmake" INSTALL_DESTINATION "${package_dir}"
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/capfitConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/capfitConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/capfitConfigVersion.cmake"
  DESTINATION "${package_dir}" COMPONENT library)
