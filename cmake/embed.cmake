# haarmony_embed(TARGET FUNCTION name FILES path... AS name...): a static library with the
# bytes of the files and `std::span<const http::EmbeddedFile> name()`,
# the AS names being what the files are called in it, in the same order.
#
# The assembler's .incbin takes any bytes, at no cost in compile time.
function(haarmony_embed target)
    cmake_parse_arguments(ARG "" "FUNCTION" "FILES;AS" ${ARGN})
    set(assembly "    .section .rodata\n")
    set(declarations "")
    set(entries "")
    set(i 0)
    foreach(file name IN ZIP_LISTS ARG_FILES ARG_AS)
        set(symbol ${ARG_FUNCTION}_${i})
        string(APPEND assembly "    .global ${symbol}\n    .global ${symbol}_end\n"
                               "${symbol}:\n    .incbin \"${file}\"\n${symbol}_end:\n")
        string(APPEND declarations
               "extern \"C\" const char ${symbol}[];\nextern \"C\" const char ${symbol}_end[];\n")
        string(APPEND entries
               "        {\"${name}\", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},\n")
        math(EXPR i "${i} + 1")
    endforeach()
    string(APPEND assembly "    .section .note.GNU-stack,\"\",@progbits\n")

    set(base ${CMAKE_CURRENT_BINARY_DIR}/${target})
    file(CONFIGURE OUTPUT ${base}.S CONTENT "${assembly}" @ONLY)
    file(CONFIGURE OUTPUT ${base}.cc @ONLY CONTENT "#include <array>
#include <cstddef>

#include \"server/http/static_files.h\"

${declarations}
namespace haarmony::server {

std::span<const http::EmbeddedFile> ${ARG_FUNCTION}() {
    static const std::array<http::EmbeddedFile, ${i}> files{{
${entries}    }};
    return files;
}

}  // namespace haarmony::server
")
    set_source_files_properties(${base}.S PROPERTIES OBJECT_DEPENDS "${ARG_FILES}")
    add_library(${target} STATIC ${base}.S ${base}.cc)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
endfunction()
