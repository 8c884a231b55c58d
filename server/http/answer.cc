#include "server/http/answer.h"

#include <utility>
#include <variant>

#include "server/http/conditional.h"
#include "server/http/content_encoding.h"
#include "server/http/file_body.h"
#include "server/http/problem.h"

namespace haarmony::http {

Answer answer(const Router& router, Request& request, const FailureReport& failed) {
    Response response = router.dispatch(request, failed);
    const bool compress = select_gzip(request, response);
    apply_conditions(request, response);
    if (compress && response.status == 200) gzip_body(response);
    std::optional<std::uint64_t> length = body_length(response);
    if (const auto* range = std::get_if<FileRange>(&response.body)) {
        Result<ChunkSource> source = open_file_range(*range);
        if (source) {
            response.body = *std::move(source);
        } else {
            if (failed) failed(request, source.error().message);
            response = to_response(problem_of(source.error()), request);
            length = body_length(response);
        }
    }
    return {std::move(response), length};
}

}  // namespace haarmony::http
