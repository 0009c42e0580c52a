# jet_add_plugin(<name> SOURCES <files>... [LIBRARIES <targets>...] [UI] [OUTPUT_FOLDER <folder>])
#
# Builds <name>.so from the sources and puts it with plugin.json (beside the calling CMakeLists.txt) into
# <build>/lib/jet/plugins/<id>/. The built manifest also names the SDK version and the compiler ABI it was built with, so
# that the host can refuse a mismatch before any code of the plugin runs. UI: the plugin brings a Qt widget.
# OUTPUT_FOLDER: puts it into <folder>/<id>/ instead, where only --plugin-path finds it, and does not install it.
#
# Targets: <name> (the library) and <name>-objects (its objects, for unit tests).
#
# jet_add_plugin_test(<name> SOURCES <files>... [PLUGINS <targets>...] [LIBRARIES <targets>...] [UI])
#
# A GoogleTest program on the test kit Jet::Testing (#include <jet/testing/gtest.hpp>), run by ctest. It loads plugins by
# id from where jet_add_plugin() put them, and the shipped ones from the installed JET. PLUGINS: the targets it needs
# built; all of this CMakeLists.txt if not given. UI: it makes Qt widgets, without a display.

set(JET_PLUGIN_CMAKE_DIR "${CMAKE_CURRENT_LIST_DIR}")

# What JET_SDK_VERSION and JET_ABI_TAG expand to for this compiler, asked of the preprocessor.
function(jet_sdk_tags version_variable abi_variable)
    get_target_property(includes Jet::Sdk INTERFACE_INCLUDE_DIRECTORIES)
    foreach(directory IN LISTS includes)
        string(REGEX REPLACE "^\\$<(BUILD_INTERFACE|INSTALL_INTERFACE):(.*)>$" "\\2" directory "${directory}")
        if(EXISTS "${directory}/jet/version.hpp")
            set(header "${directory}/jet/version.hpp")
        endif()
    endforeach()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
    set(probe "${CMAKE_BINARY_DIR}/jet-tags.cpp")
    file(WRITE "${probe}.in" "#include \"${header}\"\nJETVERSION=JET_SDK_VERSION;\nJETABI=JET_ABI_TAG;\n")
    configure_file("${probe}.in" "${probe}" COPYONLY)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -E -P "${probe}" OUTPUT_VARIABLE expanded COMMAND_ERROR_IS_FATAL ANY)
    foreach(pair "JETVERSION;${version_variable}" "JETABI;${abi_variable}")
        list(GET pair 0 key)
        list(GET pair 1 variable)
        string(REGEX MATCH "${key}=([^;]*);" ignored "${expanded}")
        string(REGEX REPLACE "[\" ]" "" value "${CMAKE_MATCH_1}")
        set(${variable} "${value}" PARENT_SCOPE)
    endforeach()
endfunction()

function(jet_add_plugin name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "UI" "OUTPUT_FOLDER" "SOURCES;LIBRARIES")
    set(manifest "${CMAKE_CURRENT_SOURCE_DIR}/plugin.json")
    if(NOT EXISTS "${manifest}")
        message(FATAL_ERROR "jet_add_plugin(${name}): ${manifest} is missing. Each plugin needs a manifest beside its CMakeLists.txt.")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${manifest}")
    file(READ "${manifest}" json)
    string(JSON id ERROR_VARIABLE problem GET "${json}" id)
    if(problem)
        message(FATAL_ERROR "${manifest}: no \"id\": ${problem}")
    endif()

    # Asked once a configuration and not cached: a build folder may outlive the SDK it was configured with.
    get_property(tags GLOBAL PROPERTY JET_BUILT_FOR)
    if(NOT tags)
        jet_sdk_tags(sdk_version sdk_abi)
        set(tags "{\"sdk\": \"${sdk_version}\", \"abi\": \"${sdk_abi}\"}")
        set_property(GLOBAL PROPERTY JET_BUILT_FOR "${tags}")
    endif()
    string(JSON json SET "${json}" builtFor "${tags}")

    set(folder "${CMAKE_BINARY_DIR}/lib/jet/plugins/${id}")
    if(arg_OUTPUT_FOLDER)
        set(folder "${arg_OUTPUT_FOLDER}/${id}")
    endif()
    file(MAKE_DIRECTORY "${folder}")
    file(CONFIGURE OUTPUT "${folder}/plugin.json" CONTENT "${json}\n" @ONLY)

    add_library(${name}-objects OBJECT ${arg_SOURCES})
    set_target_properties(${name}-objects PROPERTIES
        CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(${name}-objects PRIVATE -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
    target_link_libraries(${name}-objects PUBLIC Jet::Sdk ${arg_LIBRARIES})
    if(arg_UI)
        if(NOT TARGET Qt6::Widgets AND NOT TARGET jet-sdk-ui)
            message(FATAL_ERROR "jet_add_plugin(${name} UI) needs Qt 6.4 Widgets; on Debian: apt-get install qt6-base-dev")
        endif()
        target_link_libraries(${name}-objects PUBLIC Jet::SdkUi)
    endif()

    add_library(${name} MODULE $<TARGET_OBJECTS:${name}-objects>)
    set_target_properties(${name} PROPERTIES PREFIX "" LINKER_LANGUAGE CXX LIBRARY_OUTPUT_DIRECTORY "${folder}"
        INSTALL_RPATH "$ORIGIN/../../..")
    target_link_libraries(${name} PRIVATE ${name}-objects)
    if(NOT JET_SANITIZE)
        target_link_options(${name} PRIVATE -Wl,-z,defs)
    endif()

    file(GLOB icons "${CMAKE_CURRENT_SOURCE_DIR}/*.svg")
    foreach(icon IN LISTS icons)
        get_filename_component(icon_name "${icon}" NAME)
        configure_file("${icon}" "${folder}/${icon_name}" COPYONLY)
    endforeach()

    set_property(DIRECTORY APPEND PROPERTY JET_PLUGINS_HERE ${name})
    cmake_path(GET folder PARENT_PATH searched)
    set_property(DIRECTORY APPEND PROPERTY JET_PLUGIN_FOLDERS_HERE "${searched}")

    if(arg_OUTPUT_FOLDER)
        return()
    endif()
    include(GNUInstallDirs)
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/jet/plugins/${id})
    install(FILES "${folder}/plugin.json" ${icons} DESTINATION ${CMAKE_INSTALL_LIBDIR}/jet/plugins/${id})
    set_property(GLOBAL APPEND PROPERTY JET_PLUGIN_TARGETS ${name})
endfunction()

function(jet_add_plugin_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "UI" "" "SOURCES;PLUGINS;LIBRARIES")
    if(NOT arg_SOURCES)
        message(FATAL_ERROR "jet_add_plugin_test(${name}): no SOURCES given.")
    endif()
    find_package(GTest QUIET)
    if(NOT GTest_FOUND)
        message(WARNING "${name} is not built: it needs GoogleTest; on Debian: apt-get install libgtest-dev")
        return()
    endif()
    include(GoogleTest)
    if(NOT arg_PLUGINS)
        get_property(arg_PLUGINS DIRECTORY PROPERTY JET_PLUGINS_HERE)
    endif()
    get_property(folders DIRECTORY PROPERTY JET_PLUGIN_FOLDERS_HERE)
    list(APPEND folders "${CMAKE_BINARY_DIR}/lib/jet/plugins")
    list(REMOVE_DUPLICATES folders)

    # Where the test finds its plugins, known to the program itself, so that it also runs without ctest.
    set(code "#include <jet/testing/catalog.hpp>\n\n[[maybe_unused]] static const bool added = true")
    foreach(folder IN LISTS folders)
        string(APPEND code " &&\n    jet::test::addPluginPath(R\"(${folder})\")")
    endforeach()
    string(APPEND code ";\n")
    set(paths "${CMAKE_CURRENT_BINARY_DIR}/${name}-plugin-path.cpp")
    file(CONFIGURE OUTPUT "${paths}" CONTENT "${code}" @ONLY)

    add_executable(${name} ${arg_SOURCES} "${paths}")
    set_target_properties(${name} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
    target_compile_options(${name} PRIVATE -ffp-contract=off)
    target_link_libraries(${name} PRIVATE Jet::Testing GTest::gtest GTest::gtest_main ${arg_LIBRARIES})
    if(arg_UI)
        target_link_libraries(${name} PRIVATE Jet::SdkUi)
    endif()
    if(arg_PLUGINS)
        add_dependencies(${name} ${arg_PLUGINS})
    endif()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
        PROPERTIES TIMEOUT 300 ENVIRONMENT "QT_QPA_PLATFORM=offscreen" LABELS unit)
endfunction()
