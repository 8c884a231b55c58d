#include "ingest/gallery/varnish.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ingest/gallery/noise.h"

namespace haarmony::gallery {
namespace {

constexpr double kShoulder = 0.75;  // light above this is rolled off
constexpr double kWhite = 3.0;      // light that becomes display white
constexpr int kCurveSteps = 8192;

double rolled_off(double light) {
    if (light <= kShoulder) return light;
    const double room = 1 - kShoulder;
    return kShoulder + room * (1 - exponential(-(light - kShoulder) / room));
}

double encoded(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * power(light, 1 / 2.4) - 0.055;
}

// Display values of evenly spaced light; between them a straight line is off by less than
// a tenth of a step of the display, even where the curve is steepest.
const std::array<float, kCurveSteps + 1>& display_curve() {
    static const auto kCurve = [] {
        std::array<float, kCurveSteps + 1> curve{};
        for (int i = 0; i <= kCurveSteps; ++i) {
            const double light = kWhite * i / kCurveSteps;
            curve[static_cast<std::size_t>(i)] =
                static_cast<float>(255 * encoded(rolled_off(light)));
        }
        return curve;
    }();
    return kCurve;
}

// A quarter of the size, blurred, holding only what is brighter than display white allows.
Canvas bright_parts(const Canvas& canvas) {
    const int width = std::max(1, canvas.width() / 4);
    const int height = std::max(1, canvas.height() / 4);
    Canvas small(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Color sum;
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i)
                    sum = sum + canvas.at(std::min(4 * x + i, canvas.width() - 1),
                                          std::min(4 * y + j, canvas.height() - 1));
            sum = sum * (1.0 / 16);
            const double light = std::max({sum.r, sum.g, sum.b});
            small.set(x, y, sum * (smoothstep(0.7, 1.4, light)));
        }
    }
    return small;
}

bool any_light(const Canvas& canvas) {
    for (int y = 0; y < canvas.height(); ++y)
        for (int x = 0; x < canvas.width(); ++x)
            if (luminance(canvas.at(x, y)) > 1e-4) return true;
    return false;
}

void box_blur(Canvas& canvas, int half) {
    const auto pass = [&](int lines, int count, auto get, auto put) {
        std::vector<Color> old(static_cast<std::size_t>(count));
        for (int line = 0; line < lines; ++line) {
            for (int i = 0; i < count; ++i)
                old[static_cast<std::size_t>(i)] = get(line, i);
            const auto clamped = [&](int i) {
                return old[static_cast<std::size_t>(std::clamp(i, 0, count - 1))];
            };
            Color sum;
            for (int i = -half; i <= half; ++i) sum = sum + clamped(i);
            for (int i = 0; i < count; ++i) {
                put(line, i, sum * (1.0 / (2 * half + 1)));
                sum = sum + clamped(i + half + 1) + clamped(i - half) * -1.0;
            }
        }
    };
    pass(
        canvas.height(),
        canvas.width(),
        [&](int y, int x) { return canvas.at(x, y); },
        [&](int y, int x, const Color& c) { canvas.set(x, y, c); });
    pass(
        canvas.width(),
        canvas.height(),
        [&](int x, int y) { return canvas.at(x, y); },
        [&](int x, int y, const Color& c) { canvas.set(x, y, c); });
}

}  // namespace

void apply(const Varnish& varnish, Canvas& canvas) {
    Canvas spill = bright_parts(canvas);
    const int half = std::max(1, std::min(spill.width(), spill.height()) / 28);
    for (int i = 0; i < 3; ++i) box_blur(spill, half);
    const Point middle{canvas.aspect() / 2, 0.5};
    const double corner = middle.x * middle.x + middle.y * middle.y;
    // Sampling four neighbours for nothing would cost as much as the rest.
    const bool blooms = varnish.bloom > 0 && any_light(spill);
    canvas.rework([&](Point p, const Color& below) {
        Color c = below;
        if (blooms) c = c + spill.sample(p) * varnish.bloom;
        const double grey = luminance(c);
        if (varnish.saturation != 1) {
            c = mix({grey, grey, grey}, c, varnish.saturation);
            c = {std::max(0.0, c.r), std::max(0.0, c.g), std::max(0.0, c.b)};
        }
        const Point d = p - middle;
        return c * (1 - varnish.vignette * (d.x * d.x + d.y * d.y) / corner);
    });
}

std::vector<std::uint8_t> to_bytes(const Varnish& varnish, const Canvas& canvas) {
    const auto& curve = display_curve();
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(canvas.width()) *
                                    canvas.height() * 3);
    const auto scale = static_cast<float>(kCurveSteps / kWhite);
    const auto white = static_cast<float>(kWhite);
    const auto display = [&](double light) {
        const float position = std::clamp(static_cast<float>(light), 0.0F, white) * scale;
        const int step = std::min(static_cast<int>(position), kCurveSteps - 1);
        const auto i = static_cast<std::size_t>(step);
        return curve[i] +
               (curve[i + 1] - curve[i]) * (position - static_cast<float>(step));
    };
    // The sum of two uniform values is a triangle, whose deviation is 0.41.
    const auto strength = static_cast<float>(varnish.grain * 255 / 0.41 * 0x1.0p-16);
    std::uint8_t* next = bytes.data();
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            const Color c = canvas.at(x, y);
            const std::uint32_t chance = lattice_hash(x, y, varnish.seed);
            const int speck = static_cast<int>(chance & 0xFFFF) +
                              static_cast<int>(chance >> 16) - 0xFFFF;
            const float grain = static_cast<float>(speck) * strength + 0.5F;
            for (const double light : {c.r, c.g, c.b})
                *next++ = static_cast<std::uint8_t>(
                    std::clamp(display(light) + grain, 0.0F, 255.0F));
        }
    }
    return bytes;
}

}  // namespace haarmony::gallery
