# Headers that nearly all files include are compiled once for all targets with the same flags (docs/decisions/0070).
#
# Only headers of the system are among them (C++, Eigen, Qt, GoogleTest), which do not change: ours are read by each file
# that includes them, so that touching one compiles no more than it must. A file still includes what it uses:
# -DJET_PRECOMPILED_HEADERS=OFF builds without.
option(JET_PRECOMPILED_HEADERS "Compile the headers of libraries once for all targets" ON)

set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # what folders find, jet_precompile_all() must know
set(JET_PRECOMPILED_SOURCE "${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp")

# By what a target links to. Named as they are included: a path would keep one checkout from what another has cached.
set(JET_PRECOMPILED_core <Eigen/Dense> <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstdlib>
    <cstring> <deque> <filesystem> <fstream> <functional> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional>
    <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple> <unordered_map> <utility> <variant>
    <vector>)
set(JET_PRECOMPILED_qt <QtWidgets/QtWidgets>)
set(JET_PRECOMPILED_test <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)

# Everything a target links to, directly or not.
function(jet_linked_by target result)
    set(open ${target})
    set(known)
    while(open)
        list(POP_FRONT open next)
        foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
            get_target_property(libraries ${next} ${property})
            foreach(library IN LISTS libraries)
                string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
                if(TARGET "${library}" AND NOT library IN_LIST known)
                    list(APPEND known "${library}")
                    list(APPEND open "${library}")
                endif()
            endforeach()
        endforeach()
    endwhile()
    set(${result} "${known}" PARENT_SCOPE)
endfunction()

# Gives the target the compiled headers of its kind: what it links to says which headers, its flags which compilation.
function(jet_precompile target)
    get_target_property(type ${target} TYPE)
    get_target_property(sources ${target} SOURCES)
    if(NOT type MATCHES "^(EXECUTABLE|(OBJECT|STATIC|SHARED|MODULE)_LIBRARY)$" OR NOT sources MATCHES "\\.cpp(;|$)")
        return()
    endif()
    jet_linked_by(${target} linked)
    if(NOT Jet::Sdk IN_LIST linked AND NOT jet-sdk IN_LIST linked AND NOT target STREQUAL jet-sdk)
        return()  # without the macros of the SDK
    endif()
    set(kind core)
    set(headers ${JET_PRECOMPILED_core})
    set(libraries Eigen3::Eigen)
    if(Qt6::Widgets IN_LIST linked)
        set(kind qt)
        list(APPEND headers ${JET_PRECOMPILED_qt})
        list(APPEND libraries Qt6::Widgets)
    endif()
    get_target_property(options ${target} COMPILE_OPTIONS)
    list(FILTER options INCLUDE REGEX "-O[0-3]")
    string(REGEX MATCH "-O[0-3]" optimization "${options}")
    if(GTest::gtest IN_LIST linked AND optimization)  # not for what measures, and stands on the support of tests
        string(APPEND kind -test)
        list(APPEND headers ${JET_PRECOMPILED_test})
        list(APPEND libraries GTest::gmock nlohmann_json::nlohmann_json)
    endif()
    string(APPEND kind "${optimization}")

    set(owner jet-precompiled-${kind})
    if(NOT TARGET ${owner})
        add_library(${owner} OBJECT EXCLUDE_FROM_ALL "${JET_PRECOMPILED_SOURCE}")
        target_precompile_headers(${owner} PRIVATE ${headers})
        target_link_libraries(${owner} PRIVATE ${libraries})
        target_compile_definitions(${owner} PRIVATE $<TARGET_PROPERTY:jet-sdk,INTERFACE_COMPILE_DEFINITIONS>)
        target_compile_options(${owner} PRIVATE ${options})
    endif()
    target_precompile_headers(${target} REUSE_FROM ${owner})
    # g++ 12 finds faults in std::string which it keeps to itself unless the header was compiled before.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
    endif()
endfunction()

# All targets of the folder and of those below it.
function(jet_precompile_all folder)
    if(NOT JET_PRECOMPILED_HEADERS)
        return()
    endif()
    get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        jet_precompile(${target})
    endforeach()
    get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    foreach(below IN LISTS folders)
        jet_precompile_all("${below}")
    endforeach()
endfunction()
