#include "ingest/gallery/lsystem.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "ingest/gallery/elementary.h"

namespace haarmony::gallery {

std::string rewrite(const Grammar& grammar,
                    int generations,
                    std::size_t limit,
                    Random& random) {
    std::string symbols = grammar.axiom;
    for (int i = 0; i < generations; ++i) {
        std::string next;
        for (const char symbol : symbols) {
            const auto rule = std::find_if(
                grammar.rules.begin(), grammar.rules.end(), [&](const Rule& r) {
                    return r.symbol == symbol;
                });
            if (rule == grammar.rules.end())
                next += symbol;
            else
                next += random.pick(std::span<const std::string>(rule->successors));
        }
        if (next.size() > limit) break;
        symbols = std::move(next);
    }
    return symbols;
}

Plant grow(std::string_view symbols, const Turtle& turtle, Random& random) {
    struct State {
        Point at;
        double heading = 0;
        int depth = 0;
    };
    Plant plant;
    State now;
    std::vector<State> remembered;
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        switch (symbols[i]) {
            case 'F': {
                now.heading -= turtle.lift * sine(now.heading);
                const double step = power(turtle.shrink, now.depth);
                const Point to = now.at + turned({0, -step}, now.heading);
                plant.twigs.push_back(
                    {now.at,
                     to,
                     now.depth,
                     static_cast<double>(i) / static_cast<double>(symbols.size())});
                now.at = to;
                break;
            }
            case '+':
                now.heading += turtle.angle + turtle.wander * random.bell();
                break;
            case '-':
                now.heading -= turtle.angle + turtle.wander * random.bell();
                break;
            case '[':
                remembered.push_back(now);
                ++now.depth;
                break;
            case ']':
                if (remembered.empty()) break;
                now = remembered.back();
                remembered.pop_back();
                break;
            case 'L':
            case '*':
                plant.buds.push_back({now.at, now.heading, symbols[i] == '*'});
                break;
            default:
                break;
        }
    }
    return plant;
}

Plant fitted(const Plant& plant, Point foot, double width, double height) {
    double left = 0;
    double right = 0;
    double top = -1e-6;
    for (const Twig& twig : plant.twigs) {
        left = std::min(left, twig.to.x);
        right = std::max(right, twig.to.x);
        top = std::min(top, twig.to.y);
    }
    // The foot stays where it is: the wider side decides.
    const double half = std::max({right, -left, 1e-6});
    const double scale = std::min(height / -top, width / 2 / half);
    Plant placed = plant;
    for (Twig& twig : placed.twigs) {
        twig.from = foot + twig.from * scale;
        twig.to = foot + twig.to * scale;
    }
    for (Bud& bud : placed.buds) bud.at = foot + bud.at * scale;
    return placed;
}

}  // namespace haarmony::gallery
