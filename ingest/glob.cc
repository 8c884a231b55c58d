#include "ingest/glob.h"

#include <cassert>
#include <optional>
#include <utility>
#include <vector>

namespace haarmony::ingest {
namespace {

// One element of a pattern: what it may take, and where the next one starts.
struct Element {
    enum class Kind { kByte, kAny, kSet, kRun, kRunAcross, kFolders };
    Kind kind = Kind::kByte;
    char byte = 0;
    std::string_view set;  // between the brackets, after '!'
    bool negated = false;
};

// The index of the bracket that closes the set opened before `start`; a ']' that comes
// first belongs to the set.
std::optional<std::size_t> set_end(std::string_view pattern, std::size_t start) {
    std::size_t i = start;
    if (i < pattern.size() && (pattern[i] == '!' || pattern[i] == '^')) ++i;
    const std::size_t close = pattern.find(']', i + 1);
    if (close == std::string_view::npos) return std::nullopt;
    return close;
}

std::vector<Element> parse(std::string_view pattern) {
    std::vector<Element> elements;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char c = pattern[i];
        Element element;
        if (c == '*') {
            element.kind = Element::Kind::kRun;
            if (i + 1 < pattern.size() && pattern[i + 1] == '*') {
                ++i;
                element.kind = Element::Kind::kRunAcross;
                const bool starts_segment = i == 1 || pattern[i - 2] == '/';
                if (starts_segment && i + 1 < pattern.size() && pattern[i + 1] == '/') {
                    ++i;
                    element.kind = Element::Kind::kFolders;
                }
            }
        } else if (c == '?') {
            element.kind = Element::Kind::kAny;
        } else if (const auto close = c == '[' ? set_end(pattern, i + 1) : std::nullopt) {
            element.kind = Element::Kind::kSet;
            element.set = pattern.substr(i + 1, *close - i - 1);
            element.negated = element.set[0] == '!' || element.set[0] == '^';
            if (element.negated) element.set.remove_prefix(1);
            i = *close;
        } else {
            if (c == '\\' && i + 1 < pattern.size()) ++i;
            element.byte = pattern[i];
        }
        elements.push_back(element);
    }
    return elements;
}

bool set_contains(std::string_view set, char c) {
    const auto byte = static_cast<unsigned char>(c);
    for (std::size_t i = 0; i < set.size(); ++i) {
        const auto low = static_cast<unsigned char>(set[i]);
        if (i + 2 < set.size() && set[i + 1] == '-') {
            if (byte >= low && byte <= static_cast<unsigned char>(set[i + 2]))
                return true;
            i += 2;
        } else if (byte == low) {
            return true;
        }
    }
    return false;
}

bool takes(const Element& element, char c) {
    switch (element.kind) {
        case Element::Kind::kByte:
            return c == element.byte;
        case Element::Kind::kAny:
        case Element::Kind::kRun:
            return c != '/';
        case Element::Kind::kSet:
            return c != '/' && set_contains(element.set, c) != element.negated;
        case Element::Kind::kRunAcross:
        case Element::Kind::kFolders:
            return true;
    }
    return false;
}

}  // namespace

// All positions of the pattern that the text read so far can have reached, as a set: no
// backtracking, so that no pattern is slow.
bool glob_matches(std::string_view pattern, std::string_view text) {
    const std::vector<Element> elements = parse(pattern);
    std::vector<char> reached(elements.size() + 1, 0);
    std::vector<char> next(elements.size() + 1, 0);
    // What may take nothing is passed at once; `**/` only where a folder starts.
    const auto pass_empty = [&elements](std::vector<char>& positions,
                                        bool folder_starts) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const Element::Kind kind = elements[i].kind;
            if (positions[i] &&
                (kind == Element::Kind::kRun || kind == Element::Kind::kRunAcross ||
                 (kind == Element::Kind::kFolders && folder_starts))) {
                positions[i + 1] = 1;
            }
        }
    };
    reached[0] = 1;
    pass_empty(reached, true);
    for (const char c : text) {
        next.assign(next.size(), 0);
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (!reached[i] || !takes(elements[i], c)) continue;
            const bool stays = elements[i].kind == Element::Kind::kRun ||
                               elements[i].kind == Element::Kind::kRunAcross ||
                               elements[i].kind == Element::Kind::kFolders;
            next[stays ? i : i + 1] = 1;
        }
        pass_empty(next, c == '/');
        std::swap(reached, next);
    }
    return reached[elements.size()] != 0;
}

Exclusion::Exclusion(std::string pattern) : pattern_(std::move(pattern)) {
    assert(!pattern_.empty());
    if (pattern_.size() > 1 && pattern_.back() == '/') {
        folders_only_ = true;
        pattern_.pop_back();
    }
    whole_path_ = pattern_.find('/') != std::string::npos;
    if (pattern_.size() > 1 && pattern_.front() == '/') pattern_.erase(0, 1);
}

bool Exclusion::matches(std::string_view below, bool is_folder) const {
    if (folders_only_ && !is_folder) return false;
    if (!whole_path_) below.remove_prefix(below.rfind('/') + 1);
    return glob_matches(pattern_, below);
}

}  // namespace haarmony::ingest
