#include "engine/curve/svg_path.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "engine/curve/elliptical_arc.h"

namespace haarmony::curve {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\f' || c == '\r';
}
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// What stands at a position, short enough for a message of one line.
std::string excerpt(std::string_view text, std::size_t at) {
    if (at >= text.size()) return "the end";
    constexpr std::size_t kLongest = 16;
    std::string shown = "'";
    for (const char c : text.substr(at, kLongest))
        shown += c >= ' ' && c <= '~' ? c : '?';
    shown += text.size() - at > kLongest ? "...'" : "'";
    return shown;
}

// Numbers, flags and separators of the grammar, from the front to the back.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    [[nodiscard]] std::size_t position() const { return at_; }
    [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
    [[nodiscard]] char next() const { return at_end() ? '\0' : text_[at_]; }
    void skip_one() { ++at_; }
    void skip_space() {
        while (!at_end() && is_space(text_[at_])) ++at_;
    }
    void skip_comma() {
        skip_space();
        if (next() != ',') return;
        ++at_;
        skip_space();
    }
    [[nodiscard]] bool number_follows() const {
        return next() == '+' || next() == '-' || next() == '.' || is_digit(next());
    }

    std::optional<double> number() {
        std::size_t end = at_;
        if (next() == '+' || next() == '-') ++end;
        const std::size_t digits = end;
        end = after_digits(end);
        bool valid = end > digits;
        if (end < text_.size() && text_[end] == '.') {
            const std::size_t fraction = end + 1;
            end = after_digits(fraction);
            valid = end > fraction;
        }
        if (!valid) return fail(at_, "expected a number");
        if (end < text_.size() && lower(text_[end]) == 'e') {
            std::size_t power = end + 1;
            if (power < text_.size() && (text_[power] == '+' || text_[power] == '-'))
                ++power;
            // Without digits the e is not part of the number.
            if (after_digits(power) > power) end = after_digits(power);
        }
        const char* first = text_.data() + at_ + (next() == '+' ? 1 : 0);
        double value = 0;
        const std::errc code = std::from_chars(first, text_.data() + end, value).ec;
        if (code != std::errc()) return fail(at_, "expected a number within doubles");
        at_ = end;
        return value;
    }

    std::optional<bool> flag() {
        if (next() != '0' && next() != '1') {
            fail(at_, "expected a flag, 0 or 1");
            return std::nullopt;
        }
        return text_[at_++] == '1';
    }

    std::nullopt_t fail(std::size_t at, const std::string& what) {
        error_ = Error{ErrorCode::kInvalidArgument,
                       "path data, position " + std::to_string(at) + ": " + what +
                           ", found " + excerpt(text_, at),
                       "d"};
        return std::nullopt;
    }
    [[nodiscard]] Error error() && { return std::move(error_); }

  private:
    [[nodiscard]] std::size_t after_digits(std::size_t from) const {
        while (from < text_.size() && is_digit(text_[from])) ++from;
        return from;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Error error_;
};

PathPoint operator+(PathPoint a, PathPoint b) { return {a.x + b.x, a.y + b.y}; }
// The point at `t` between a and b.
PathPoint between(PathPoint a, PathPoint b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
PathPoint mirrored(PathPoint point, PathPoint center) {
    return {center.x + (center.x - point.x), center.y + (center.y - point.y)};
}
// Not so large that squares of coordinates overflow.
bool is_moderate(PathPoint point) {
    return std::fabs(point.x) <= kMostPathCoordinate &&
           std::fabs(point.y) <= kMostPathCoordinate;
}

class PathReader {
  public:
    explicit PathReader(std::string_view text) : scanner_(text) {}

    Result<std::vector<SvgSubpath>> read() {
        scanner_.skip_space();
        if (!scanner_.at_end() && lower(scanner_.next()) != 'm') {
            scanner_.fail(scanner_.position(), "expected a moveto, M or m");
            return std::move(scanner_).error();
        }
        while (!scanner_.at_end()) {
            if (!command()) return std::move(scanner_).error();
            scanner_.skip_space();
        }
        finish_subpath(false);
        if (subpaths_.empty()) {
            scanner_.fail(scanner_.position(), "expected something that is drawn");
            return std::move(scanner_).error();
        }
        return std::move(subpaths_);
    }

  private:
    // A command letter and its arguments, as often as they follow.
    bool command() {
        const std::size_t at = scanner_.position();
        char letter = scanner_.next();
        if (std::string_view("mlhvcsqtaz").find(lower(letter)) ==
                std::string_view::npos ||
            letter == '\0') {
            scanner_.fail(at, "expected a command");
            return false;
        }
        scanner_.skip_one();
        scanner_.skip_space();
        if (lower(letter) == 'z') {
            close();
            return true;
        }
        bool more = true;
        while (more) {
            const std::size_t start = scanner_.position();
            origin_ = letter == lower(letter) ? current_ : PathPoint{};
            if (!arguments(lower(letter))) return false;
            if (!moderate_) {
                scanner_.fail(start, "expected coordinates up to 1e100");
                return false;
            }
            previous_ = lower(letter);
            // Further pairs of a moveto are linetos.
            if (letter == 'm') letter = 'l';
            if (letter == 'M') letter = 'L';
            // A comma belongs to the grammar only between two arguments.
            scanner_.skip_space();
            more = scanner_.next() == ',' || scanner_.number_follows();
            if (more) scanner_.skip_comma();
        }
        return true;
    }

    bool arguments(char kind) {
        switch (kind) {
            case 'm':
                return move_to();
            case 'l':
                return pair() && line_to(read_);
            case 'h':
                return coordinate() && line_to({origin_.x + coordinate_, current_.y});
            case 'v':
                return coordinate() && line_to({current_.x, origin_.y + coordinate_});
            case 'c':
            case 's':
                return cubic_to(kind == 's');
            case 'q':
            case 't':
                return quadratic_to(kind == 't');
            default:
                return arc_to();
        }
    }

    bool coordinate() {
        const std::optional<double> value = scanner_.number();
        coordinate_ = value.value_or(0);
        return value.has_value();
    }
    // A pair of coordinates, made absolute, into read_.
    bool pair() {
        if (!coordinate()) return false;
        const double x = coordinate_;
        scanner_.skip_comma();
        if (!coordinate()) return false;
        read_ = origin_ + PathPoint{x, coordinate_};
        return true;
    }
    bool pair_after_comma() {
        scanner_.skip_comma();
        return pair();
    }
    bool number_after_comma() {
        scanner_.skip_comma();
        return coordinate();
    }

    bool move_to() {
        if (!pair()) return false;
        finish_subpath(false);
        start_ = current_ = read_;
        moderate_ = is_moderate(current_);
        return true;
    }
    bool line_to(PathPoint to) {
        append(between(current_, to, 1.0 / 3), between(to, current_, 1.0 / 3), to);
        return true;
    }
    bool cubic_to(bool smooth) {
        PathPoint first = current_;
        if (smooth) {
            if (previous_ == 'c' || previous_ == 's') first = mirrored(handle_, current_);
        } else {
            if (!pair()) return false;
            first = read_;
            scanner_.skip_comma();
        }
        if (!pair()) return false;
        const PathPoint second = read_;
        if (!pair_after_comma()) return false;
        append(first, second, read_);
        handle_ = second;
        return true;
    }
    bool quadratic_to(bool smooth) {
        PathPoint middle = current_;
        if (smooth) {
            if (previous_ == 'q' || previous_ == 't')
                middle = mirrored(handle_, current_);
        } else {
            if (!pair()) return false;
            middle = read_;
            scanner_.skip_comma();
        }
        if (!pair()) return false;
        append(
            between(current_, middle, 2.0 / 3), between(read_, middle, 2.0 / 3), read_);
        handle_ = middle;
        return true;
    }
    bool arc_to() {
        EllipticalArc arc;
        arc.from = current_;
        if (!coordinate()) return false;
        arc.radius_x = coordinate_;
        if (!number_after_comma()) return false;
        arc.radius_y = coordinate_;
        if (!number_after_comma()) return false;
        arc.rotation_degrees = coordinate_;
        scanner_.skip_comma();
        const std::optional<bool> large = scanner_.flag();
        if (!large) return false;
        scanner_.skip_comma();
        const std::optional<bool> sweep = scanner_.flag();
        if (!sweep) return false;
        if (!pair_after_comma()) return false;
        arc.large = *large;
        arc.sweep = *sweep;
        arc.to = read_;
        const std::vector<PathPoint> points = arc_beziers(arc);
        for (std::size_t i = 0; i < points.size(); i += 3)
            append(points[i], points[i + 1], points[i + 2]);
        return true;
    }

    void append(PathPoint first, PathPoint second, PathPoint to) {
        if (bezier_.empty()) bezier_.push_back(start_);
        for (const PathPoint point : {first, second, to}) {
            bezier_.push_back(point);
            moderate_ = moderate_ && is_moderate(point);
        }
        current_ = to;
    }

    void close() {
        if (current_ != start_ || bezier_.empty()) line_to(start_);
        finish_subpath(true);
        current_ = start_;
        previous_ = 'z';
    }

    void finish_subpath(bool closed) {
        if (bezier_.empty()) return;
        SvgSubpath subpath{Points(bezier_.size(), 2), closed};
        for (std::size_t i = 0; i < bezier_.size(); ++i) {
            subpath.bezier[i][0] = bezier_[i].x;
            subpath.bezier[i][1] = bezier_[i].y;
        }
        subpaths_.push_back(std::move(subpath));
        bezier_.clear();
    }

    Scanner scanner_;
    std::vector<SvgSubpath> subpaths_;
    std::vector<PathPoint> bezier_;  // of the subpath being read
    PathPoint start_;                // of the subpath
    PathPoint current_;
    PathPoint origin_;  // what coordinates are relative to
    PathPoint handle_;  // the last control point, which S and T mirror
    PathPoint read_;
    double coordinate_ = 0;
    char previous_ = '\0';
    bool moderate_ = true;  // all coordinates so far
};

}  // namespace

Result<std::vector<SvgSubpath>> parse_svg_path(std::string_view text) {
    return PathReader(text).read();
}

}  // namespace haarmony::curve
