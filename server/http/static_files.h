// The page: files out of a directory, or out of the executable.
//
// "/" is index.html. Only regular files below the directory are served, by names without a
// leading dot; a symbolic link counts as what it points to, and must not lead outside.
// Everything else is a 404.
//
// Every file has an ETag (strong: of its bytes if embedded or up to kHashed, else of its size
// and time), is revalidated on each use, and carries a Content-Security-Policy that lets the
// page load only from here, besides pictures that it makes itself.
//
// Errors  open() gives kNotFound if there is no such directory.
// Threads const-safe.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "server/http/message.h"

namespace haarmony::http {

inline constexpr std::size_t kHashed = 1024 * 1024;  // bytes

struct EmbeddedFile {
    std::string_view path;  // "index.html", "js/canvas.js"
    std::string_view content;
};

class StaticFiles {
  public:
    [[nodiscard]] static Result<StaticFiles> open(const std::filesystem::path& directory);
    // The files and what they point to must outlive this.
    explicit StaticFiles(std::span<const EmbeddedFile> embedded);

    // For Router::set_fallback().
    [[nodiscard]] Response operator()(const Request& request) const;

  private:
    explicit StaticFiles(std::filesystem::path root) : root_(std::move(root)) {}
    [[nodiscard]] Response from_directory(const Request& request,
                                          const std::string& name) const;
    [[nodiscard]] Response from_memory(const Request& request,
                                       const std::string& name) const;

    std::filesystem::path root_;  // canonical; empty if embedded
    std::span<const EmbeddedFile> embedded_;
};

// By the name's extension; application/octet-stream if it is not known.
[[nodiscard]] std::string_view media_type_of(std::string_view name);

}  // namespace haarmony::http
