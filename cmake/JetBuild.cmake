# Compiler, linker and output settings for the whole tree.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Programs are compiled as libraries are, so that both take the same compiled headers (JetPrecompiled.cmake).
set(CMAKE_CXX_COMPILE_OPTIONS_PIE ${CMAKE_CXX_COMPILE_OPTIONS_PIC})

set(CMAKE_CXX_FLAGS_RELEASE "-O2 -g1 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

# Floating point is part of the contract: the same scene gives the same bits (see docs/decisions).
add_compile_options(-Wall -Wextra -Wpedantic -ffp-contract=off -fvisibility=hidden -fvisibility-inlines-hidden)
option(JET_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
if(JET_WARNINGS_AS_ERRORS)
    add_compile_options(-Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fno-gnu-unique)
endif()

set(JET_SANITIZE "" CACHE STRING "Sanitizers to build with, for -fsanitize=")
if(JET_SANITIZE)
    add_compile_options(-fsanitize=${JET_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined -O1)
    add_link_options(-fsanitize=${JET_SANITIZE})
endif()

find_program(JET_CCACHE ccache)
if(JET_CCACHE)
    # It takes what a file includes from the compiler, instead of preprocessing a second time: 6 % of a cold build.
    # Of compiled headers it takes the content (JetPrecompiled.cmake), new as they may be, whatever macros were defined before.
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${JET_CCACHE})
endif()
find_program(JET_MOLD mold)
if(JET_MOLD)
    add_link_options(-fuse-ld=mold)
endif()

# bin/jet, lib/libjet-sdk.so, lib/jet/plugins/<id>/: it runs from the build folder as it does when installed.
include(GNUInstallDirs)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
