#include "server/api/image_id.h"

#include "server/api/inputs.h"

namespace haarmony::server {

Outcome<ImageId> image_id_of(const http::Request& request) {
    const std::string& text = request.path_parameters.at("id");
    const std::optional<std::int64_t> id = parse_integer(text);
    if (id && *id > 0) return ImageId{*id};
    return Error{ErrorCode::kInvalidArgument,
                 "'" + text.substr(0, 40) + "' is not an id: a whole number above 0",
                 "id"};
}

std::string etag_of(const schema::Image& image) {
    return '"' + std::to_string(to_int(image.id)) + '-' + std::to_string(image.revision) +
           '"';
}

std::optional<http::Problem> refuse_parameters(const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return inputs->refused();
}

}  // namespace haarmony::server
