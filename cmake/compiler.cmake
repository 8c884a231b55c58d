# Flags that every target of ours shares, as one interface target.
add_library(haarmony_compiler INTERFACE)
target_include_directories(haarmony_compiler INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(
    haarmony_compiler
    INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor
              -Wno-sign-conversion
              # Contracted multiply-adds would make signatures depend on the machine.
              -ffp-contract=off)
if(HAARMONY_WERROR)
    target_compile_options(haarmony_compiler INTERFACE -Werror)
endif()

# ccache keeps precompiled headers only when told that it may; in depend mode it does not
# preprocess a file that it must compile anyway; and with the inode cache it does not read
# the 90 MB of a precompiled header again for each file.
find_program(CCACHE ccache)
if(CCACHE)
    set(launcher env CCACHE_DEPEND=1 CCACHE_INODECACHE=1
        CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
    set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

# haarmony_precompile(NAME HEADERS... USES targets...): a target without code whose headers
# are compiled once; haarmony_precompiled_by(TARGET NAME) lets a target begin with them.
# Only g++ is told to: clang wants the same -D for every file. A file must go on including
# what it uses, which the presets without precompiled headers verify.
function(haarmony_precompile name)
    if(HAARMONY_PRECOMPILED)
        cmake_parse_arguments(ARG "" "" "HEADERS;USES" ${ARGN})
        file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc "")
        add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc)
        target_link_libraries(${name} PRIVATE haarmony_compiler ${ARG_USES})
        target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
    endif()
endfunction()
function(haarmony_precompiled_by target name)
    if(HAARMONY_PRECOMPILED)
        target_precompile_headers(${target} REUSE_FROM ${name})
    endif()
endfunction()

set(HAARMONY_STANDARD_HEADERS
    <algorithm> <array> <chrono> <cmath> <cstdint> <functional> <map> <memory>
    <optional> <random> <set> <span> <string> <string_view> <thread> <utility> <vector>)
haarmony_precompile(haarmony_standard_headers HEADERS ${HAARMONY_STANDARD_HEADERS})

# haarmony_library(NAME SOURCES... USES targets...): a static library with our flags.
function(haarmony_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC haarmony_compiler ${ARG_USES})
    haarmony_precompiled_by(${name} haarmony_standard_headers)
endfunction()

# haarmony_executable(NAME SOURCES... USES targets...): an executable with our flags.
function(haarmony_executable name)
    cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE haarmony_compiler ${ARG_USES})
    haarmony_precompiled_by(${name} haarmony_standard_headers)
endfunction()
