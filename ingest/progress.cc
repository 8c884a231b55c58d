#include "ingest/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "ingest/file_uri.h"

namespace haarmony::ingest {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kBarCells = 24;

std::chrono::milliseconds interval_of(ProgressMode mode) {
    switch (mode) {
        case ProgressMode::kBar:
            return kBarInterval;
        case ProgressMode::kJson:
            return kJsonInterval;
        case ProgressMode::kPlain:
        case ProgressMode::kNone:
            break;
    }
    return kPlainInterval;
}

std::string fixed(double value, int digits) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

std::string counts(const Tally& tally) {
    return "seen=" + std::to_string(tally.seen) +
           " added=" + std::to_string(tally.added) +
           " updated=" + std::to_string(tally.updated) +
           " skipped=" + std::to_string(tally.skipped) +
           " failed=" + std::to_string(tally.failed) +
           " pruned=" + std::to_string(tally.pruned);
}

Json event(const char* name, const Tally& tally) {
    return {{"event", name},
            {"seen", tally.seen},
            {"added", tally.added},
            {"updated", tally.updated},
            {"skipped", tally.skipped},
            {"failed", tally.failed},
            {"pruned", tally.pruned}};
}

// File names need not be UTF-8; what is not becomes U+FFFD (`uri` keeps every byte).
std::string line_of(const Json& object) {
    return object.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

// "4:05", "1:04:05".
std::string clock_text(double seconds) {
    constexpr double kLongest = 359'999;  // 99:59:59
    const int whole = static_cast<int>(std::min(seconds, kLongest) + 0.5);
    std::array<char, 32> text{};
    if (whole >= 3600) {
        std::snprintf(text.data(),
                      text.size(),
                      "%d:%02d:%02d",
                      whole / 3600,
                      whole / 60 % 60,
                      whole % 60);
    } else {
        std::snprintf(text.data(), text.size(), "%d:%02d", whole / 60, whole % 60);
    }
    return text.data();
}

}  // namespace

void Rate::update(std::int64_t count, TimePoint now) {
    const double seconds = std::chrono::duration<double>(now - last_time_).count();
    if (seconds <= 0) return;
    const double kept =
        std::exp(-seconds / std::chrono::duration<double>(kRateMemory).count());
    sum_ = sum_ * kept + (1 - kept) * static_cast<double>(count - last_count_) / seconds;
    weight_ = weight_ * kept + (1 - kept);
    last_time_ = now;
    last_count_ = count;
}

std::optional<double> Rate::seconds_for(std::int64_t count) const {
    if (per_second() <= 0) return std::nullopt;
    return static_cast<double>(count) / per_second();
}

Progress::Progress(ProgressMode mode,
                   int columns,
                   std::ostream& out,
                   std::ostream& err,
                   std::function<Clock::time_point()> clock)
    : mode_(mode),
      columns_(columns),
      out_(out),
      err_(err),
      clock_(std::move(clock)),
      start_(clock_()),
      next_(mode == ProgressMode::kPlain ? start_ + interval_of(mode) : start_),
      rate_(start_) {}

void Progress::failed(const std::string& path, const std::string& reason) {
    clear_bar();
    err_ << "failed: " << printable_line(path) << ": " << printable_line(reason)
         << std::endl;
    if (mode_ != ProgressMode::kJson) return;
    Json failure{{"event", "failed"}, {"path", path}, {"reason", reason}};
    if (path.starts_with('/')) failure["uri"] = file_uri(path);
    out_ << line_of(failure) << std::flush;
}

void Progress::progress(const Tally& tally, std::int64_t total) {
    const Clock::time_point now = clock_();
    if (mode_ == ProgressMode::kNone || now < next_) return;
    next_ = now + interval_of(mode_);
    rate_.update(tally.seen, now);
    if (mode_ == ProgressMode::kBar) {
        draw_bar(tally, total);
    } else if (mode_ == ProgressMode::kJson) {
        Json object = event("progress", tally);
        object["total"] = total >= 0 ? Json(total) : Json(nullptr);
        object["rate"] = rate_.per_second();
        const std::optional<double> eta = eta_s(tally, total);
        object["eta_s"] = eta ? Json(*eta) : Json(nullptr);
        out_ << line_of(object) << std::flush;
    } else {
        out_ << "progress: " << counts(tally);
        if (total >= 0) out_ << " total=" << total;
        out_ << " rate=" << fixed(rate_.per_second(), 1);
        if (const auto eta = eta_s(tally, total)) out_ << " eta_s=" << fixed(*eta, 0);
        out_ << std::endl;
    }
}

void Progress::done(const Tally& tally) {
    clear_bar();
    const double seconds = std::chrono::duration<double>(clock_() - start_).count();
    if (mode_ == ProgressMode::kJson) {
        Json object = event("done", tally);
        object["seconds"] = std::round(seconds * 1000) / 1000;
        out_ << line_of(object) << std::flush;
    } else {
        out_ << "done: " << counts(tally) << " seconds=" << fixed(seconds, 3)
             << std::endl;
    }
}

void Progress::draw_bar(const Tally& tally, std::int64_t total) {
    std::string line;
    if (total > 0) {
        const double part =
            std::min(1.0, static_cast<double>(tally.seen) / static_cast<double>(total));
        const int cells = static_cast<int>(part * kBarCells);
        line = '[' + std::string(static_cast<std::size_t>(cells), '#') +
               std::string(static_cast<std::size_t>(kBarCells - cells), '-') + "] " +
               fixed(std::floor(part * 100), 0) + "% ";
    }
    line += std::to_string(tally.seen);
    if (total >= 0) line += '/' + std::to_string(total);
    line += " files, " + fixed(rate_.per_second(), 1) + "/s";
    if (const auto eta = eta_s(tally, total)) line += ", " + clock_text(*eta) + " left";
    if (tally.failed > 0) line += ", " + std::to_string(tally.failed) + " failed";
    // A line as wide as the terminal would wrap, and could not be drawn over.
    const auto widest = static_cast<std::size_t>(std::max(columns_ - 1, 1));
    out_ << '\r' << line.substr(0, widest) << "\x1b[K" << std::flush;
    bar_shown_ = true;
}

void Progress::clear_bar() {
    if (!bar_shown_) return;
    out_ << "\r\x1b[K" << std::flush;
    bar_shown_ = false;
}

std::optional<double> Progress::eta_s(const Tally& tally, std::int64_t total) const {
    if (total < 0) return std::nullopt;
    return rate_.seconds_for(std::max<std::int64_t>(0, total - tally.seen));
}

std::string printable_line(std::string_view text) {
    constexpr char kHex[] = "0123456789abcdef";
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            line += "\\x";
            line += kHex[byte >> 4];
            line += kHex[byte & 15];
        } else {
            line += c;
        }
    }
    return line;
}

}  // namespace haarmony::ingest
