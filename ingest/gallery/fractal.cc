#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/painters.h"

namespace haarmony::gallery {
namespace {

struct Complex {
    double re = 0;
    double im = 0;
};

// What an escaping orbit tells of its starting point.
struct Orbit {
    bool escaped = false;
    double time = 0;   // continuous
    double trap = 0;   // nearest approach to the trap
    double light = 0;  // -1 .. 1, of the potential seen as a hill lit from the upper left
};

constexpr int kMostSteps = 224;
constexpr double kFar = 400;  // squared; the larger, the smoother the time

enum class Formula { kSquare, kShip };

// What is worth knowing of the orbits; what is not costs nothing.
struct Wanted {
    bool trap;
    bool light;
};

Orbit escape(Complex z,
             Complex c,
             bool of_parameter,
             Formula formula,
             const Wanted& wanted) {
    Complex slope{of_parameter ? 0.0 : 1.0, 0};
    double trap = 1e9;
    Complex remembered = z;
    int next_memory = 8;
    for (int step = 0; step < kMostSteps; ++step) {
        const double re2 = z.re * z.re;
        const double im2 = z.im * z.im;
        if (re2 + im2 > kFar) {
            const double logs =
                logarithm(logarithm(re2 + im2) / 2 / 2.9957322736) / 0.69314718056;
            // The normal of the potential is z / z'.
            const double size = slope.re * slope.re + slope.im * slope.im;
            Complex u{(z.re * slope.re + z.im * slope.im) / size,
                      (z.im * slope.re - z.re * slope.im) / size};
            const double norm = std::sqrt(u.re * u.re + u.im * u.im);
            const double light =
                wanted.light && norm > 0 ? (u.re * -0.7071 + u.im * -0.7071) / norm : 0;
            return {true, step + 1 - logs, std::sqrt(trap), light};
        }
        // An orbit that comes back to where it was goes round for ever.
        // Looking at every fourth point only finds the same orbits, a little later.
        if ((step & 3) == 0 && step > 0) {
            if (std::fabs(z.re - remembered.re) + std::fabs(z.im - remembered.im) < 1e-9)
                break;
            if (step == next_memory) {
                remembered = z;
                next_memory *= 2;
            }
        }
        if (wanted.trap && step > 0)
            trap = std::min({trap, re2 + 0.02, im2 + 0.02, re2 + im2});
        if (wanted.light)
            slope = {2 * (z.re * slope.re - z.im * slope.im) + (of_parameter ? 1.0 : 0.0),
                     2 * (z.re * slope.im + z.im * slope.re)};
        const double cross = 2 * z.re * z.im;
        z = {re2 - im2 + c.re,
             (formula == Formula::kShip ? -std::fabs(cross) : cross) + c.im};
    }
    return {false, kMostSteps, std::sqrt(trap), 0};
}

Ramp cyclic_ramp(Random& random, double hue) {
    const std::vector<double> hues = harmony(random, hue);
    const bool dark = random.chance(0.65);
    const Color first = oklch(dark ? 0.16 : 0.95, dark ? 0.08 : 0.04, hues[0]);
    return {first,
            oklch(0.45, 0.18, hues[0]),
            oklch(0.70, 0.19, hues[2]),
            oklch(0.95, 0.10, hues[3]),
            oklch(0.72, 0.19, hues[1]),
            oklch(0.38, 0.16, hues[4]),
            first};
}

struct View {
    const char* name;
    Complex centre;
    double height;
};

// Places worth a visit.
constexpr View kPlaces[] = {{"Seahorse valley", {-0.7453, 0.1127}, 0.013},
                            {"Spiral garden", {0.36024044, -0.64131306}, 0.011},
                            {"Double spiral", {-0.7436438870, 0.1318259043}, 0.0009},
                            {"Mandelbrot set", {-0.65, 0.0}, 2.5},
                            {"Triple spiral", {-0.0887, 0.6545}, 0.024},
                            {"Lightning", {-1.25066, 0.02012}, 0.0022},
                            {"Northern bulb", {-0.158, 1.0335}, 0.05},
                            {"Needle", {-1.7685, 0.0017}, 0.032},
                            {"Spiral sea", {-0.7463, 0.1102}, 0.0045},
                            {"Quad spiral", {0.27423, 0.48482}, 0.0145}};

constexpr Complex kSeeds[] = {{-0.8, 0.156},
                              {0.285, 0.01},
                              {-0.4, 0.6},
                              {-0.70176, -0.3842},
                              {-0.835, -0.2321},
                              {-0.7269, 0.1889},
                              {0.355, 0.355},
                              {-0.54, 0.54},
                              {-0.1, 0.651},
                              {0.34, -0.05},
                              {-1.0, 0.28},
                              {0.37, 0.1},
                              {-0.162, 1.04},
                              {-0.194, 0.6557}};

// Colours one point; the picture is what it makes of every pixel.
template <typename F>
void render(Canvas& canvas, F&& color) {
    canvas.cover(color);
    // Only where neighbours differ much is one sample a pixel too few.
    std::vector<bool> rough(static_cast<std::size_t>(canvas.width()) * canvas.height());
    for (int y = 0; y + 1 < canvas.height(); ++y) {
        for (int x = 0; x + 1 < canvas.width(); ++x) {
            const Color a = canvas.at(x, y);
            const Color b = canvas.at(x + 1, y) + a * -1.0;
            const Color c = canvas.at(x, y + 1) + a * -1.0;
            const double difference = std::fabs(b.r) + std::fabs(b.g) + std::fabs(b.b) +
                                      std::fabs(c.r) + std::fabs(c.g) + std::fabs(c.b);
            rough[static_cast<std::size_t>(y) * canvas.width() + x] = difference > 0.5;
        }
    }
    const double third = canvas.pixel() / 3;
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            if (!rough[static_cast<std::size_t>(y) * canvas.width() + x]) continue;
            const Point p = canvas.point(x, y);
            const Color sum = canvas.at(x, y) + color(p + Point{third, -third}) +
                              color(p + Point{-third, third});
            canvas.set(x, y, sum * (1.0 / 3));
        }
    }
}

// How an orbit is coloured.
struct Style {
    Ramp ramp;
    double cycles;  // of the ramp for each doubling of time
    double shift;
    double relief;   // how much the light shapes it
    double trapped;  // how much the trap colours it
    Color inside;

    [[nodiscard]] Wanted wanted() const { return {trapped > 0, relief > 0}; }

    [[nodiscard]] Color operator()(const Orbit& orbit) const {
        const double trap = clamp01(orbit.trap * 1.2);
        if (!orbit.escaped && trapped == 0) return inside;
        if (!orbit.escaped) return inside + ramp.around(shift + trap) * (0.25 * trap);
        const double t = logarithm(orbit.time + 3) * cycles + shift;
        const Color c = mix(ramp.around(t), ramp.around(shift + 1.4 * trap), trapped);
        return c * (1 + relief * orbit.light);
    }
};

Style make_style(Random& random, double hue) {
    return {cyclic_ramp(random, hue),
            random.between(0.55, 1.5),
            random.unit(),
            random.pick({0.0, 0.35, 0.6}),
            random.pick({0.0, 0.25, 0.6, 0.9}),
            oklch(random.between(0.05, 0.22), 0.06, hue + 0.4)};
}

Label mandelbrot(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const View view =
        kPlaces[static_cast<std::size_t>(commission.turn / 4) % std::size(kPlaces)];
    const Style style = make_style(random, commission.hue);
    const double angle = view.height > 1 ? 0 : random.between(-kPi, kPi);
    const double height =
        view.height * random.between(0.85, 1.15) / std::min(1.0, canvas.aspect());
    const Point middle{canvas.aspect() / 2, 0.5};
    const double c = cosine(angle) * height;
    const double s = sine(angle) * height;
    render(canvas, [&](Point p) {
        const Point d = p - middle;
        const Complex at{view.centre.re + d.x * c - d.y * s,
                         view.centre.im + d.x * s + d.y * c};
        return style(escape({0, 0}, at, true, Formula::kSquare, style.wanted()));
    });
    return {view.name, {"fractal", "mandelbrot"}};
}

Label julia(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    Complex seed =
        kSeeds[static_cast<std::size_t>(commission.turn / 2) % std::size(kSeeds)];
    seed.re += random.between(-0.004, 0.004);
    seed.im += random.between(-0.004, 0.004);
    const Style style = make_style(random, commission.hue);
    const bool whole = random.chance(0.6);
    const double height = (whole ? random.between(1.9, 2.6) : random.between(0.4, 0.9)) /
                          std::min(1.0, canvas.aspect());
    const double angle = random.between(-kPi, kPi);
    const Point middle{canvas.aspect() / 2, 0.5};
    const Point offset =
        whole ? Point{0, 0}
              : Point{random.between(-0.5, 0.5), random.between(-0.35, 0.35)};
    const double c = cosine(angle) * height;
    const double s = sine(angle) * height;
    render(canvas, [&](Point p) {
        const Point d = p - middle;
        return style(escape({offset.x + d.x * c - d.y * s, offset.y + d.x * s + d.y * c},
                            seed,
                            false,
                            Formula::kSquare,
                            style.wanted()));
    });
    return {"Julia set", {"fractal", "julia"}};
}

Label burning_ship(Canvas& canvas, Commission& commission) {
    static constexpr View kShips[] = {{"Burning ship", {-1.762, -0.028}, 0.075},
                                      {"Burning armada", {-1.625, -0.005}, 0.09},
                                      {"Ship's mast", {-1.941, -0.002}, 0.016}};
    const View view =
        kShips[static_cast<std::size_t>(commission.turn / 8) % std::size(kShips)];
    const Style style = make_style(commission.random, commission.hue);
    const double height = view.height * commission.random.between(0.7, 1.2);
    const Point middle{canvas.aspect() / 2, 0.5};
    render(canvas, [&](Point p) {
        const Complex at{view.centre.re + (p.x - middle.x) * height,
                         view.centre.im + (p.y - middle.y) * height};
        // The derivative is not this formula's: its light would be wrong.
        const Wanted wanted{style.wanted().trap, false};
        return style(escape({0, 0}, {at.re, -at.im}, true, Formula::kShip, wanted));
    });
    return {view.name, {"fractal", "burning ship"}};
}

// Newton's method for z^n = 1: which root is reached, and how soon.
Label newton(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const int degree = 3 + commission.turn / 8 % 4;
    std::vector<Complex> roots;
    std::vector<Color> colors;
    const std::vector<double> hues = harmony(random, commission.hue);
    for (int i = 0; i < degree; ++i) {
        roots.push_back({cosine(kTurn * i / degree), sine(kTurn * i / degree)});
        colors.push_back(oklch(
            random.between(0.5, 0.82), 0.18, hues[static_cast<std::size_t>(i) % 5]));
    }
    const double relax = random.between(0.9, 1.5);
    const double height = random.between(0.9, 2.6);
    const double angle = random.between(0, kTurn);
    const Point off{random.between(-0.3, 0.3) * height,
                    random.between(-0.3, 0.3) * height};
    const Point middle{canvas.aspect() / 2, 0.5};
    render(canvas, [&](Point p) {
        const Point d = turned((p - middle) * height, angle) + off;
        Complex z{d.x, d.y};
        double nearness = 0;
        for (int step = 0; step < 40; ++step) {
            Complex below{1, 0};
            for (int i = 1; i < degree; ++i)
                below = {below.re * z.re - below.im * z.im,
                         below.re * z.im + below.im * z.re};
            const double size = below.re * below.re + below.im * below.im;
            if (size < 1e-12) break;
            // z - relax (z^n - 1) / (n z^(n-1))
            const Complex quotient{below.re / size, -below.im / size};
            z = {z.re - relax * (z.re - quotient.re) / degree,
                 z.im - relax * (z.im - quotient.im) / degree};
            for (int i = 0; i < degree; ++i) {
                const Complex& root = roots[static_cast<std::size_t>(i)];
                const double away = (z.re - root.re) * (z.re - root.re) +
                                    (z.im - root.im) * (z.im - root.im);
                nearness += 1 / (1 + away * 60);
                if (away > 1e-4) continue;
                const double t = clamp01(step / 22.0 + 0.15 * nearness / (step + 1));
                const Color c = colors[static_cast<std::size_t>(i)];
                return mix(c * 1.15 + Color{0.12, 0.12, 0.12}, c * 0.06, t);
            }
        }
        return Color{0.01, 0.01, 0.02};
    });
    return {"Newton basins of degree " + std::to_string(degree), {"fractal", "newton"}};
}

}  // namespace

Label paint_fractal(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {
        mandelbrot, julia, newton, julia, mandelbrot, julia, burning_ship, julia};
    return kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
}

}  // namespace haarmony::gallery
