# gridreel::build_flags: what every target of ours compiles with.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(GRIDREEL_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them: address,undefined or thread")
option(GRIDREEL_UNITY_BUILD "Compile many sources at a time: quick from nothing, slow after each change" OFF)
option(GRIDREEL_WERROR "Treat warnings as errors" OFF)

add_library(gridreel_build_flags INTERFACE)
add_library(gridreel::build_flags ALIAS gridreel_build_flags)
target_compile_features(gridreel_build_flags INTERFACE cxx_std_20)
target_include_directories(gridreel_build_flags INTERFACE ${PROJECT_SOURCE_DIR})
# No contraction: kernels ask for fused multiply-add by name, so pixels do not depend on the compiler's mood.
target_compile_options(gridreel_build_flags INTERFACE -ffp-contract=off)
if(PROJECT_IS_TOP_LEVEL)  # a project around ours has its own opinion
  # Sources compiled as one shadow each other's constants.
  target_compile_options(gridreel_build_flags INTERFACE
    -Wall -Wextra -Wconversion $<$<NOT:$<BOOL:${GRIDREEL_UNITY_BUILD}>>:-Wshadow>
    $<$<BOOL:${GRIDREEL_WERROR}>:-Werror>)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # Highway has no one-register target below SSSE3.
  target_compile_options(gridreel_build_flags INTERFACE -march=x86-64-v2)
endif()
if(GRIDREEL_SANITIZE)
  target_compile_options(gridreel_build_flags INTERFACE -fsanitize=${GRIDREEL_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(gridreel_build_flags INTERFACE -fsanitize=${GRIDREEL_SANITIZE})
endif()

# Most of compiling is reading the headers of others. Where only the result counts, as in a release and for
# clang-tidy, a target's sources go many at a time.
function(gridreel_read_headers_once target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GRIDREEL_UNITY_BUILD}
    UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include)")
endfunction()
