#include "server/page.h"

#include <array>
#include <system_error>

#include "server/embedded.h"

namespace haarmony::server {

namespace fs = std::filesystem;

Result<http::StaticFiles> open_page(const std::optional<std::string>& web,
                                    const fs::path& executable) {
    if (web) {
        Result<http::StaticFiles> page = http::StaticFiles::open(*web);
        if (page) return page;
        return Error{ErrorCode::kInvalidArgument, "--web " + *web + " is not a folder"};
    }
    const fs::path folder = executable.parent_path();
    const std::array<fs::path, 2> places{folder / "web",
                                         folder / "../share/haarmony/web"};
    for (const fs::path& place : places) {
        std::error_code error;
        if (fs::is_regular_file(place / "index.html", error))
            return http::StaticFiles::open(place);
    }
    return http::StaticFiles(embedded_web());
}

}  // namespace haarmony::server
