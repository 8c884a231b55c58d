#include "engine/curve/built_in_character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "engine/curve/level.h"

namespace haarmony::curve {
namespace {

constexpr double kLeft = 100;
constexpr double kRight = 900;
constexpr double kLine = 500;

// Seeded numbers in [0, 1) that are the same with every standard library.
class Chance {
  public:
    explicit Chance(std::uint32_t seed) : engine_(seed) {}
    double operator()() { return double(engine_()) / 4294967296.0; }

  private:
    std::mt19937 engine_;
};

struct Offset {
    double x = 0;
    double y = 0;
};

// Control point i moves off a straight line of even speed by offset(number of segments).
template <typename OffsetAt>
Points along_the_line(OffsetAt offset) {
    Points control(control_count(kBuiltInLevel, Ends::kOpen), 2);
    for (std::size_t i = 0; i < control.size(); ++i) {
        // The mean of its three inner knots, which makes the speed even.
        const double last = double(segment_count(kBuiltInLevel));
        double place = 0;
        for (int knot = -2; knot <= 0; ++knot) {
            place += std::clamp(double(i) + knot, 0.0, last) / 3;
        }
        const Offset off = offset(place);
        control[i][0] = kLeft + (kRight - kLeft) * place / last + off.x;
        control[i][1] = kLine + off.y;
    }
    return control;
}

double turn(double cycles) { return 2 * std::numbers::pi * cycles; }

// Up and down between -1 and 1 in straight lines, once a cycle.
double zigzag(double cycles) {
    return 4 * std::abs(cycles - std::floor(cycles + 0.5)) - 1;
}

// A pace that is not a machine's: cycles so far, each of them up to `share` shorter or longer.
class UnevenPace {
  public:
    UnevenPace(std::uint32_t seed, double segments_a_cycle, double share) {
        Chance chance(seed);
        const double last = double(segment_count(kBuiltInLevel));
        for (double start = 0; start <= last;) {
            starts_.push_back(start);
            start += segments_a_cycle * (1 + share * (2 * chance() - 1));
            sizes_.push_back(1 + share * (2 * chance() - 1));
            if (start > last) starts_.push_back(start);
        }
    }
    [[nodiscard]] double cycles(double place) const {
        const std::size_t at = number(place);
        return double(at) + (place - starts_[at]) / (starts_[at + 1] - starts_[at]);
    }
    // About 1, another for each cycle.
    [[nodiscard]] double size(double place) const { return sizes_[number(place)]; }

  private:
    [[nodiscard]] std::size_t number(double place) const {
        const auto after = std::ranges::upper_bound(starts_, place);
        return std::size_t(after - starts_.begin()) - 1;
    }

    std::vector<double> starts_;
    std::vector<double> sizes_;
};

Points smooth() {
    return along_the_line([](double) { return Offset{}; });
}

Points wiggly() {
    const UnevenPace pace(11, 12, 0.25);
    return along_the_line([&](double place) {
        return Offset{0, 12 * std::sin(turn(pace.cycles(place)))};
    });
}

// The pen goes to and fro on a slant.
Points hatched() {
    const UnevenPace pace(12, 8, 0.2);
    return along_the_line([&](double place) {
        const double swing = pace.size(place) * zigzag(pace.cycles(place));
        return Offset{14 * swing, 26 * swing};
    });
}

// A calm line with a thorn now and then.
Points spiky() {
    const UnevenPace pace(13, 16, 0.4);
    return along_the_line([&](double place) {
        const double thorn = std::max(0.0, 3 * zigzag(pace.cycles(place)) - 2);
        return Offset{0, -45 * pace.size(place) * thorn};
    });
}

// Loops of an unhurried hand, leaning to the right.
Points loose() {
    const UnevenPace pace(14, 14, 0.3);
    return along_the_line([&](double place) {
        const double angle = turn(pace.cycles(place));
        const double up = -24 * (1 - std::cos(angle)) / 2 * pace.size(place);
        return Offset{20 * std::sin(angle) - 0.4 * up, up};
    });
}

// Bumps with sharp valleys, like the outline of a cloud.
Points scalloped() {
    const UnevenPace pace(15, 14, 0.3);
    return along_the_line([&](double place) {
        const double bump = std::abs(std::sin(turn(pace.cycles(place)) / 2));
        return Offset{0, -20 * bump * pace.size(place)};
    });
}

// A pen on a rough ground.
Points rough() {
    Chance chance(16);
    return along_the_line([&](double) {
        const double x = chance();
        const double y = chance();
        return Offset{3 * (2 * x - 1), 7 * (2 * y - 1)};
    });
}

constexpr std::array<BuiltInCharacter, 7> kCharacters = {{
    {"hatched", hatched},
    {"loose", loose},
    {"rough", rough},
    {"scalloped", scalloped},
    {"smooth", smooth},
    {"spiky", spiky},
    {"wiggly", wiggly},
}};

}  // namespace

std::span<const BuiltInCharacter> built_in_characters() { return kCharacters; }

const BuiltInCharacter* built_in_character(std::string_view name) {
    const auto found = std::ranges::find(kCharacters, name, &BuiltInCharacter::name);
    return found == kCharacters.end() ? nullptr : &*found;
}

}  // namespace haarmony::curve
