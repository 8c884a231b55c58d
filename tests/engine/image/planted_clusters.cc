#include "tests/engine/image/planted_clusters.h"

#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {

std::vector<Signature> planted_clusters(std::mt19937& random, int groups, int each) {
    std::vector<Signature> signatures;
    int serial = 0;
    for (int group = 0; group < groups; ++group) {
        Signature center;
        do center = random_signature(random, {.max_index = 2000, .average_steps = 4});
        while (center.channels[0].count < 50);
        for (int i = 0; i < each; ++i) {
            Signature variation = center;
            ChannelSignature& channel = variation.channels[0];
            for (int j = 0; j < channel.count; ++j) {
                // Indices that no center has, so that none is there twice.
                if (random() % 10 == 0) {
                    channel.indices[j] = static_cast<std::int16_t>(2001 + j);
                }
            }
            channel.average += ++serial;
            signatures.push_back(variation);
        }
    }
    return signatures;
}

}  // namespace haarmony::image
