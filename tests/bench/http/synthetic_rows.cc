#include "tests/bench/http/synthetic_rows.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <random>

#include "engine/image/signature_codec.h"

namespace haarmony::bench {
namespace {

using image::kSide;

constexpr std::int64_t kRowsInACommit = 10'000;

// The density 1 / (x + 1) on [0, kSide), by inversion.
int coordinate(std::mt19937_64& random) {
    const double u = std::generate_canonical<double, 53>(random);
    return std::min(kSide - 1, static_cast<int>(std::pow(kSide + 1.0, u) - 1));
}

image::ChannelSignature channel(std::mt19937_64& random, bool luminance) {
    image::ChannelSignature drawn;
    std::bitset<image::kCoefficientCount> used;
    used.set(0);  // the average has no place among the coefficients
    while (drawn.count < image::kMaxCoefficients) {
        const int position = coordinate(random) * kSide + coordinate(random);
        if (used.test(static_cast<std::size_t>(position))) continue;
        used.set(static_cast<std::size_t>(position));
        const bool negative = (random() & 1U) != 0;
        drawn.indices[drawn.count++] =
            static_cast<std::int16_t>(negative ? -position : position);
    }
    // Y reaches from 0 to 1, I and Q a good half to both sides of 0.
    const double share = std::generate_canonical<double, 53>(random);
    drawn.average = static_cast<std::int32_t>((luminance ? share : share - 0.5) *
                                              static_cast<double>(image::kAverageOne));
    return drawn;
}

}  // namespace

image::Signature synthetic_signature(unsigned seed, std::int64_t number) {
    std::seed_seq both{
        seed, static_cast<unsigned>(number), static_cast<unsigned>(number >> 32)};
    std::mt19937_64 random(both);
    image::Signature signature;
    for (int c = 0; c < image::kChannels; ++c)
        signature.channels[static_cast<std::size_t>(c)] = channel(random, c == 0);
    return signature;
}

schema::NewImage synthetic_row(std::int64_t number, const image::Signature& signature) {
    schema::NewImage row;
    row.origin = schema::ImageOrigin::kFile;
    row.uri = "file:///synthetic/" + std::to_string(number % 1000) + "/" +
              std::to_string(number) + ".jpg";
    row.stamp.size = 100'000 + number;
    row.width = 1024;
    row.height = 768;
    row.media_type = "image/jpeg";
    row.signature = image::encode_signature(signature);
    return row;
}

Result<void> write_rows(const std::string& database,
                        std::int64_t images,
                        const SignatureOf& signature_of) {
    auto opened =
        schema::Database::open(database, schema::Database::Mode::kReadWriteCreate);
    if (!opened) return std::move(opened).error();
    schema::ImageStore store(opened.value());
    for (std::int64_t first = 1; first <= images; first += kRowsInACommit) {
        const std::int64_t last = std::min(images, first + kRowsInACommit - 1);
        const Result<void> written = store.transaction([&]() -> Result<void> {
            for (std::int64_t number = first; number <= last; ++number) {
                const auto id = store.add(synthetic_row(number, signature_of(number)));
                if (!id) return id.error();
            }
            return {};
        });
        if (!written) return written;
    }
    return {};
}

}  // namespace haarmony::bench
