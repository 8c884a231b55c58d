# Writes the .sql files into one .cc: cmake -DOUTPUT=.. "-DMIGRATIONS=a.sql;b.sql" -P this.
# The files must be numbered 0001, 0002, ... without a gap, in this order: the number is the
# version that the database has afterwards.
set(version 0)
set(rows "")
foreach(path IN LISTS MIGRATIONS)
    math(EXPR version "${version} + 1")
    get_filename_component(name "${path}" NAME)
    string(REGEX MATCH "^([0-9][0-9][0-9][0-9])_[a-z_]+\\.sql$" matched "${name}")
    set(number "${CMAKE_MATCH_1}")
    string(REGEX REPLACE "^0+" "" number "${number}")
    if(NOT matched OR NOT number EQUAL version)
        message(FATAL_ERROR "${name}: migration ${version} must be named like 0001_name.sql")
    endif()
    file(READ "${path}" sql)
    string(APPEND rows "    {${version}, \"${name}\", R\"__sql__(${sql})__sql__\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from schema/*.sql by schema/embed_migrations.cmake.
#include \"schema/migrate.h\"

namespace haarmony::schema {
namespace {

constexpr Migration kMigrations[] = {
${rows}};

}  // namespace

std::span<const Migration> migrations() { return kMigrations; }

}  // namespace haarmony::schema
")
