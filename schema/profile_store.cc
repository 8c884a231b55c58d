#include "schema/profile_store.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// The profile of that name gives way to the new row, whose number is the new revision.
constexpr std::string_view kPut =
    "INSERT OR REPLACE INTO profiles (name, color_space, decomposition, m, bin_rule,"
    " weights, intercept, scale, updated_at)"
    " VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))";

constexpr std::string_view kColumns =
    "SELECT name, color_space, decomposition, m, bin_rule, weights, intercept, scale,"
    " updated_at, revision FROM profiles";

std::string weights_text(const ProfileWeights& weights) {
    std::string text = "[";
    for (const auto& channel : weights) {
        if (text.size() > 1) text += ',';
        text += '[';
        for (const std::int32_t weight : channel) {
            if (text.back() != '[') text += ',';
            text += std::to_string(weight);
        }
        text += ']';
    }
    return text + ']';
}

// Takes characters from the front of what is left of a text.
class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    bool take(char expected) {
        skip_space();
        if (!text_.starts_with(expected)) return false;
        text_.remove_prefix(1);
        return true;
    }
    bool take(std::int32_t& number) {
        skip_space();
        const char* end = text_.data() + text_.size();
        const auto [after, failure] = std::from_chars(text_.data(), end, number);
        if (failure != std::errc{}) return false;
        text_.remove_prefix(static_cast<std::size_t>(after - text_.data()));
        return true;
    }
    bool at_end() {
        skip_space();
        return text_.empty();
    }

  private:
    void skip_space() {
        while (!text_.empty() && std::string_view(" \t\n\r").find(text_.front()) !=
                                     std::string_view::npos) {
            text_.remove_prefix(1);
        }
    }

    std::string_view text_;
};

std::optional<ProfileWeights> weights_of(std::string_view text) {
    Reader reader(text);
    ProfileWeights weights{};
    for (std::size_t channel = 0; channel < weights.size(); ++channel) {
        if (!reader.take(channel == 0 ? '[' : ',')) return std::nullopt;
        for (std::size_t bin = 0; bin < weights[channel].size(); ++bin) {
            if (!reader.take(bin == 0 ? '[' : ',')) return std::nullopt;
            if (!reader.take(weights[channel][bin])) return std::nullopt;
        }
        if (!reader.take(']')) return std::nullopt;
    }
    if (!reader.take(']') || !reader.at_end()) return std::nullopt;
    return weights;
}

Result<StoredProfile> profile_of(const Statement& row) {
    StoredProfile profile;
    profile.name = row.text(0);
    profile.color_space = row.text(1);
    profile.decomposition = row.text(2);
    profile.m = static_cast<int>(row.integer(3));  // the table bounds it by 2^31 - 1
    profile.bin_rule = row.text(4);
    const auto weights = weights_of(row.text(5));
    if (!weights) {
        return Error{ErrorCode::kIo,
                     "the weights of profile \"" + profile.name +
                         "\" are not 3 by 6 integers: " + std::string(row.text(5))};
    }
    profile.weights = *weights;
    if (!row.is_null(6)) profile.calibration = {row.real(6), row.real(7)};
    profile.updated_at = row.text(8);
    profile.revision = row.integer(9);
    return profile;
}

std::string quoted(std::string_view name) {
    return "profile \"" + std::string(name) + '"';
}

Error no_such_profile(std::string_view name) {
    return Error{ErrorCode::kNotFound, "no " + quoted(name), "name"};
}

}  // namespace

Result<void> ProfileStore::put(const StoredProfile& profile) {
    const auto failed = [&](Error error) {
        return while_doing("cannot store " + quoted(profile.name), std::move(error));
    };
    // SQLite has no NaN: it would be stored as no calibration.
    const auto& calibration = profile.calibration;
    if (calibration &&
        (std::isnan(calibration->first) || std::isnan(calibration->second))) {
        return failed(Error{ErrorCode::kInvalidArgument,
                            "the calibration " + std::to_string(calibration->first) +
                                ", " + std::to_string(calibration->second) +
                                " is not finite",
                            "calibration"});
    }
    const std::string weights = weights_text(profile.weights);  // outlives the loan
    auto statement = cache_.borrow(kPut);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, profile.name);
    (*statement)->bind(2, profile.color_space);
    (*statement)->bind(3, profile.decomposition);
    (*statement)->bind(4, profile.m);
    (*statement)->bind(5, profile.bin_rule);
    (*statement)->bind(6, weights);
    if (calibration) {
        (*statement)->bind_real(7, calibration->first);
        (*statement)->bind_real(8, calibration->second);
    }
    Result<void> stored = (*statement)->run();
    if (!stored) return failed(std::move(stored).error());
    return {};
}

Result<StoredProfile> ProfileStore::get(std::string_view name) {
    static const std::string sql = std::string(kColumns) + " WHERE name = ?1";
    const auto failed = [&](Error error) {
        return while_doing("cannot read " + quoted(name), std::move(error));
    };
    auto statement = cache_.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, name);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return no_such_profile(name);
    return profile_of(**statement);
}

Result<std::vector<StoredProfile>> ProfileStore::list() {
    static const std::string sql = std::string(kColumns) + " ORDER BY name";
    const auto failed = [](Error error) {
        return while_doing("cannot list the profiles", std::move(error));
    };
    auto statement = cache_.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    std::vector<StoredProfile> profiles;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return profiles;
        Result<StoredProfile> profile = profile_of(**statement);
        if (!profile) return failed(std::move(profile).error());
        profiles.push_back(std::move(profile).value());
    }
}

Result<void> ProfileStore::remove(std::string_view name) {
    const auto failed = [&](Error error) {
        return while_doing("cannot remove " + quoted(name), std::move(error));
    };
    auto statement =
        cache_.borrow("DELETE FROM profiles WHERE name = ?1 RETURNING revision");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, name);
    const auto removed = (*statement)->run_returning();
    if (!removed) return failed(removed.error());
    if (!removed->has_value()) return no_such_profile(name);
    return {};
}

}  // namespace haarmony::schema
