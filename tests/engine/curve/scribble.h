// Words in made-up letters, written again and again by a hand that is never quite the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::curve {

class Scribble {
  public:
    // Words of 4 to 8 letters of an alphabet of 16.
    Scribble(unsigned seed, std::size_t words) : random_(seed) {
        for (std::size_t i = 0; i < 16; ++i) {
            std::vector<Knot> letter;
            const std::size_t knots = 3 + random_() % 3;
            for (std::size_t k = 0; k < knots; ++k) {
                const double x = unit() * 0.9 + 0.4 * double(k) / double(knots);
                const double kind = unit();
                // Some reach above the others, some below the line.
                letter.push_back({x, kind < 0.15 ? 2 : kind < 0.3 ? -0.9 : unit()});
            }
            letter.push_back({1, 0.1});
            letters_.push_back(letter);
        }
        for (std::size_t i = 0; i < words; ++i) {
            std::vector<std::size_t> word(4 + random_() % 5);
            for (std::size_t& letter : word) letter = random_() % letters_.size();
            words_.push_back(word);
        }
    }

    // A word at a random place, size (factor e^+-0.5), slant (+-0.35), turn (+-3 degrees) and
    // speed, with noise of 1 % of a letter's height; widths of letters vary by the factor
    // `variation`, and the knots of their curves by half of it.
    Points write(std::size_t word, double variation) {
        std::vector<Knot> knots = {{-0.5, 0}};
        double x = 0;
        for (const std::size_t letter : words_[word]) {
            const double width = std::max(0.3, 1 + variation * normal());
            for (const Knot knot : letters_[letter]) {
                const double shift = 0.5 * variation * normal();
                knots.push_back(
                    {x + width * knot.x + shift, knot.y + 0.5 * variation * normal()});
            }
            x += width;
        }
        knots.push_back({x + 0.5, 0});
        return on_page(drawn(knots));
    }

  private:
    struct Knot {
        double x;
        double y;
    };

    double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    double normal() { return std::normal_distribution<double>(0, 1)(random_); }

    // A Catmull-Rom curve through the knots, faster here and slower there.
    std::vector<Knot> drawn(const std::vector<Knot>& knots) {
        std::vector<Knot> line;
        const double phase = 6 * unit();
        for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
            const Knot a = knots[i == 0 ? 0 : i - 1], b = knots[i], c = knots[i + 1];
            const Knot d = knots[std::min(i + 2, knots.size() - 1)];
            const int steps = 6 + int(5 * (1 + std::sin(phase + 0.7 * double(i))));
            for (int s = 0; s < steps; ++s) {
                const double t = double(s) / steps;
                const auto at = [&](double p, double q, double r, double o) {
                    return q + 0.5 * t *
                                   (r - p +
                                    t * (2 * p - 5 * q + 4 * r - o +
                                         t * (3 * (q - r) + o - p)));
                };
                line.push_back({at(a.x, b.x, c.x, d.x), at(a.y, b.y, c.y, d.y)});
            }
        }
        line.push_back(knots.back());
        return line;
    }

    Points on_page(const std::vector<Knot>& line) {
        const double size = 50 * std::exp(unit() - 0.5);
        const double slant = 0.35 * (2 * unit() - 1);
        const double turn = 0.05 * (2 * unit() - 1);
        const double left = 1000 * unit(), top = 1000 * unit();
        Points page(line.size(), 2);
        for (std::size_t i = 0; i < line.size(); ++i) {
            const double x = line[i].x + slant * line[i].y + 0.01 * normal();
            const double y = line[i].y + 0.01 * normal();
            page[i][0] = left + size * (std::cos(turn) * x - std::sin(turn) * y);
            page[i][1] = top + size * (std::sin(turn) * x + std::cos(turn) * y);
        }
        return page;
    }

    std::mt19937 random_;
    std::vector<std::vector<Knot>> letters_;
    std::vector<std::vector<std::size_t>> words_;
};

}  // namespace haarmony::curve
