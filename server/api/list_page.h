// One page of a list by id: where it begins, and its items with where the next one begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "server/api/inputs.h"

namespace haarmony::server {

struct ListPlace {
    static constexpr int kMostItems = 1000;
    static constexpr int kItems = 100;  // unless told otherwise

    int limit = kItems;
    std::optional<std::int64_t> cursor;  // the last id of the page before

    [[nodiscard]] static ListPlace read(Inputs& inputs) {
        const auto limit = inputs.integer("limit", 1, kMostItems).value_or(kItems);
        const auto cursor =
            inputs.integer("cursor", 1, std::numeric_limits<std::int64_t>::max());
        return {static_cast<int>(limit), cursor};
    }
    // One more than asked for tells whether there is a next page.
    [[nodiscard]] int fetched() const { return limit + 1; }
};

// {"items", "next_cursor"} of at most fetched() rows. to_json(row) has the row's "id".
template <typename Rows, typename ToJson>
[[nodiscard]] nlohmann::json list_page(const Rows& rows,
                                       const ListPlace& place,
                                       const ToJson& to_json) {
    nlohmann::json items = nlohmann::json::array();
    nlohmann::json next_cursor;
    for (const auto& row : rows) {
        if (items.size() == static_cast<std::size_t>(place.limit)) {
            next_cursor = std::to_string(items.back()["id"].template get<std::int64_t>());
            break;
        }
        items.push_back(to_json(row));
    }
    return {{"items", std::move(items)}, {"next_cursor", std::move(next_cursor)}};
}

}  // namespace haarmony::server
