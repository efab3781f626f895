# gridreel::build_flags: what every target of ours compiles with.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(GRIDREEL_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them: address,undefined or thread")
option(GRIDREEL_WERROR "Treat warnings as errors" OFF)

add_library(gridreel_build_flags INTERFACE)
add_library(gridreel::build_flags ALIAS gridreel_build_flags)
target_compile_features(gridreel_build_flags INTERFACE cxx_std_20)
target_include_directories(gridreel_build_flags INTERFACE ${PROJECT_SOURCE_DIR})
# No contraction: kernels ask for fused multiply-add by name, so pixels do not depend on the compiler's mood.
target_compile_options(gridreel_build_flags INTERFACE -ffp-contract=off)
if(PROJECT_IS_TOP_LEVEL)  # a project around ours has its own opinion
  target_compile_options(gridreel_build_flags INTERFACE
    -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${GRIDREEL_WERROR}>:-Werror>)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # Highway has no one-register target below SSSE3.
  target_compile_options(gridreel_build_flags INTERFACE -march=x86-64-v2)
endif()
if(GRIDREEL_SANITIZE)
  target_compile_options(gridreel_build_flags INTERFACE -fsanitize=${GRIDREEL_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(gridreel_build_flags INTERFACE -fsanitize=${GRIDREEL_SANITIZE})
endif()
