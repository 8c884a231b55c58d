// Where the page comes from: --web, else a folder beside the executable or in the install
// prefix, else the executable itself. The working directory never matters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "server/http/static_files.h"

namespace haarmony::server {

// kInvalidArgument naming --web where it is given and is no folder.
[[nodiscard]] Result<http::StaticFiles> open_page(
    const std::optional<std::string>& web,
    const std::filesystem::path& executable);

}  // namespace haarmony::server
