#include "server/api/strokes_json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace haarmony::server {
namespace {

using nlohmann::json;

// Far beyond every canvas, and far from where a float loses whole pixels.
constexpr double kMaxCoordinate = 1'000'000;

// Reads one drawing; stops at the first thing that is wrong.
class Reader {
  public:
    Outcome<image::StrokePicture> read(const json& value) {
        image::StrokePicture picture;
        if (!read_picture(value, picture)) return *problem_;
        return picture;
    }

  private:
    bool refuse(int status,
                const char* code,
                const std::string& at,
                const std::string& why) {
        problem_ = http::Problem{status, code, at + " " + why, at, {}};
        return false;
    }
    bool wrong(const std::string& at, const std::string& why) {
        return refuse(400, "invalid_argument", at, why);
    }

    bool is_object_of(const json& value,
                      const std::string& at,
                      std::initializer_list<std::string_view> members) {
        if (!value.is_object()) return wrong(at, "is not an object");
        for (const auto& [name, member] : value.items())
            if (std::find(members.begin(), members.end(), name) == members.end())
                return refuse(400,
                              "unknown_parameter",
                              at + "." + name.substr(0, 40),
                              "is not known here");
        return true;
    }

    bool read_picture(const json& value, image::StrokePicture& picture) {
        if (!is_object_of(value, "strokes", {"width", "height", "background", "items"}))
            return false;
        if (!read_side(value, "width", picture.width)) return false;
        if (!read_side(value, "height", picture.height)) return false;
        const json background = value.value("background", json());
        if (!background.is_null()) {
            picture.background = color_of(background);
            if (!picture.background)
                return wrong("strokes.background", "is neither null nor #rrggbb");
        }
        const auto items = value.find("items");
        if (items == value.end() || !items->is_array())
            return wrong("strokes.items", "is not an array");
        for (const json& item : *items) {
            const std::string at =
                "strokes.items[" + std::to_string(picture.items.size()) + "]";
            if (!read_stroke(item, at, picture.items.emplace_back())) return false;
        }
        if (picture.items.empty() && !picture.background)
            return refuse(422, "nothing_painted", "strokes", "has nothing painted");
        return true;
    }

    bool read_side(const json& picture, const char* name, int& side) {
        const json value = picture.value(name, json());
        if (!value.is_number_integer() || value < 1 || value > image::kMaxCanvasSide)
            return wrong(std::string("strokes.") + name,
                         "is not a whole number from 1 to " +
                             std::to_string(image::kMaxCanvasSide));
        side = value.get<int>();
        return true;
    }

    bool read_stroke(const json& value, const std::string& at, image::Stroke& stroke) {
        if (!is_object_of(value, at, {"points", "width", "color", "fill"})) return false;
        const json fill = value.value("fill", json(false));
        if (!fill.is_boolean()) return wrong(at + ".fill", "is neither true nor false");
        stroke.fill = fill.get<bool>();
        const std::optional<image::Rgb> color = color_of(value.value("color", json()));
        if (!color) return wrong(at + ".color", "is not #rrggbb");
        stroke.color = *color;
        return read_points(value, at + ".points", stroke) &&
               read_widths(value, at + ".width", stroke);
    }

    bool read_points(const json& value, const std::string& at, image::Stroke& stroke) {
        const auto points = value.find("points");
        if (points == value.end() || !points->is_array())
            return wrong(at, "is not an array of [x, y]");
        if (points->empty()) return refuse(422, "too_few_points", at, "is empty");
        point_count_ += points->size();
        if (point_count_ > static_cast<std::size_t>(image::kMaxStrokePoints))
            return refuse(
                413,
                "too_large",
                "strokes",
                "has more than " + std::to_string(image::kMaxStrokePoints) + " points");
        for (const json& point : *points) {
            const bool pair = point.is_array() && point.size() == 2 &&
                              is_coordinate(point[0]) && is_coordinate(point[1]);
            if (!pair)
                return wrong(
                    at,
                    "has " + point.dump().substr(0, 40) + " where [x, y] is expected");
            stroke.points.push_back({point[0].get<float>(), point[1].get<float>()});
        }
        return true;
    }

    // One width, or one a point; a filled shape needs none.
    bool read_widths(const json& value, const std::string& at, image::Stroke& stroke) {
        json widths = value.value("width", json());
        if (widths.is_null() && stroke.fill) return true;
        if (!widths.is_array()) widths = json::array({widths});
        if (widths.size() != 1 && widths.size() != stroke.points.size())
            return wrong(at, "is neither one number nor one for each point");
        for (const json& width : widths) {
            if (!is_coordinate(width) || width < 0)
                return wrong(at, "is not a number of pixels from 0");
            stroke.widths.push_back(width.get<float>());
        }
        return true;
    }

    static bool is_coordinate(const json& value) {
        return value.is_number() && std::abs(value.get<double>()) <= kMaxCoordinate;
    }

    static std::optional<image::Rgb> color_of(const json& value) {
        if (!value.is_string()) return {};
        const auto& text = value.get_ref<const std::string&>();
        if (text.size() != 7 || text[0] != '#') return {};
        std::array<std::uint8_t, 3> channels{};
        for (std::size_t i = 0; i < channels.size(); ++i) {
            const char* first = text.data() + 1 + 2 * i;
            const auto [stop, error] = std::from_chars(first, first + 2, channels[i], 16);
            if (error != std::errc{} || stop != first + 2) return {};
        }
        return image::Rgb{channels[0], channels[1], channels[2]};
    }

    std::optional<http::Problem> problem_;
    std::size_t point_count_ = 0;
};

}  // namespace

Outcome<image::StrokePicture> parse_strokes(const json& value) {
    return Reader().read(value);
}

}  // namespace haarmony::server
