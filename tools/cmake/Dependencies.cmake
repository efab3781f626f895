# Debian 12 packages, listed in tools/packages.txt.

find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(hwy CONFIG REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
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
