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

find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# haarmony_library(NAME SOURCES... USES targets...): a static library with our flags.
function(haarmony_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC haarmony_compiler ${ARG_USES})
endfunction()

# haarmony_executable(NAME SOURCES... USES targets...): an executable with our flags.
function(haarmony_executable name)
    cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE haarmony_compiler ${ARG_USES})
endfunction()
