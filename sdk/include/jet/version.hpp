// The version of the SDK and the tag of the compiler ABI a plugin was built with. Both are compared before a plugin
// runs.
#pragma once

#include <cstddef>  // defines the standard library macros tested below

#define JET_SDK_VERSION_MAJOR 1
#define JET_SDK_VERSION_MINOR 0
#define JET_SDK_VERSION_PATCH 0

#define JET_STRINGIZE_DETAIL(x) #x
#define JET_STRINGIZE(x) JET_STRINGIZE_DETAIL(x)
#define JET_SDK_VERSION                                                                                                \
    JET_STRINGIZE(JET_SDK_VERSION_MAJOR)                                                                               \
    "." JET_STRINGIZE(JET_SDK_VERSION_MINOR) "." JET_STRINGIZE(JET_SDK_VERSION_PATCH)

// libstdc++'s dual ABI and the Itanium ABI revision decide whether two libraries can share a std::string.
#if defined(__GLIBCXX__) && defined(_GLIBCXX_USE_CXX11_ABI)
#define JET_STDLIB_TAG "libstdc++-cxx11_" JET_STRINGIZE(_GLIBCXX_USE_CXX11_ABI)
#elif defined(_LIBCPP_VERSION)
#define JET_STDLIB_TAG "libc++"
#else
#define JET_STDLIB_TAG "unknown"
#endif
#define JET_ABI_TAG "itanium-" JET_STDLIB_TAG "-" JET_STRINGIZE(__SIZEOF_POINTER__)

// What the SDK exports. Interfaces that cross the boundary have their key function in libjet-sdk.so.
#define JET_API __attribute__((visibility("default")))
