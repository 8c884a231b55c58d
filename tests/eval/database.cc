#include "tests/eval/database.h"

#include <optional>
#include <utility>

namespace haarmony::eval {
namespace {

struct Described {
    RivalFeatures rivals;
    std::vector<image::Signature> signatures;  // in the order of the kinds
};

}  // namespace

Result<Database> make_database(const PictureSource& source,
                               const std::vector<image::SignatureKind>& kinds,
                               Executor& executor) {
    std::vector<std::optional<Described>> described(source.names.size());
    std::vector<std::string> reasons(source.names.size());
    executor.parallel_for(source.names.size(), [&](std::size_t i) {
        const Result<RgbPicture> picture = source.load(i);
        if (!picture) {
            reasons[i] = picture.error().message;
            return;
        }
        described[i].emplace();
        described[i]->rivals = describe_rivals(picture->view());
        described[i]->signatures = image::make_signatures(picture->view(), kinds);
    });

    Database database;
    for (std::size_t i = 0; i < described.size(); ++i) {
        if (!described[i]) {
            database.unreadable.push_back(source.names[i] + ": " + reasons[i]);
            continue;
        }
        database.names.push_back(source.names[i]);
        database.source_places.push_back(i);
        database.rivals.push_back(std::move(described[i]->rivals));
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            database.signatures[kinds[k]].push_back(described[i]->signatures[k]);
        }
    }
    if (database.names.empty())
        return Error{ErrorCode::kNotFound, "no picture that can be read"};
    return database;
}

std::unique_ptr<image::Index> make_index(
    const std::vector<image::Signature>& signatures) {
    std::vector<image::Record> records;
    records.reserve(signatures.size());
    for (std::size_t i = 0; i < signatures.size(); ++i)
        records.push_back({id_of(i), signatures[i]});
    // A tail of one: all is sealed at once, into the arrays that a large collection has.
    auto index =
        std::make_unique<image::Index>(image::IndexOptions{image::kMaxCoefficients, 1});
    index->apply(records, {});
    return index;
}

}  // namespace haarmony::eval
