# Debian 12 packages, listed in tools/packages.txt.

find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(hwy CONFIG REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)

# Draco's meshes. Debian's library also holds a tinygltf of its own, laid out unlike that of libtinygltf, and whichever
# the linker meets first serves both: scenes then crash as they are destroyed. So we link a copy without it.
find_package(draco CONFIG REQUIRED)
get_target_property(draco_archive draco::draco_static LOCATION)
set(draco_meshes_archive ${PROJECT_BINARY_DIR}/libdraco_meshes.a)
file(COPY_FILE ${draco_archive} ${draco_meshes_archive})
execute_process(
  COMMAND ${CMAKE_AR} d ${draco_meshes_archive} tiny_gltf_utils.cc.o gltf_decoder.cc.o mesh_io.cc.o scene_io.cc.o
  COMMAND_ERROR_IS_FATAL ANY)
add_library(draco_meshes STATIC IMPORTED)
set_target_properties(draco_meshes PROPERTIES IMPORTED_LOCATION ${draco_meshes_archive})
get_target_property(draco_includes draco::draco_static INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(draco_meshes SYSTEM INTERFACE ${draco_includes})

find_package(CLI11 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
# Its search notes that a Python library of Imath is absent; nobody here needs it.
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(OpenImageIO REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)
# Debian's target lists a folder of OpenCV that its packages do not install.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}")
find_package(benchmark QUIET)

# Embree, the rival in benchmarks: optional, and so not in tools/packages.txt (Debian's is libembree-dev, version 3).
set(GRIDREEL_EMBREE AUTO CACHE STRING "Build the tracer over Embree 3 or 4: AUTO (where found), ON or OFF")
set_property(CACHE GRIDREEL_EMBREE PROPERTY STRINGS AUTO ON OFF)
# The thread sanitizer cannot see how Embree's own code keeps its threads apart.
if(GRIDREEL_EMBREE STREQUAL "AUTO" AND GRIDREEL_SANITIZE MATCHES "thread")
  message(STATUS "Without Embree, for the thread sanitizer")
elseif(GRIDREEL_EMBREE)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 QUIET)
  endif()
  if(NOT embree_FOUND AND NOT GRIDREEL_EMBREE STREQUAL "AUTO")
    message(FATAL_ERROR "GRIDREEL_EMBREE is ON, but Embree is not found: install libembree-dev")
  endif()
endif()
