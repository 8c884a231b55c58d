// A .mrv file as a clip: layers are decoded when they are asked for, and kept while there is
// room for them.
//   mrv_writer.h -> [mrv_clip.h] -> time_tree.h
//
// The front of a file is a clip, too: its coarse space levels are there, and asking for more
// is an error.
//
// Errors   kUnsupportedFormat: not a .mrv file; kNewerVersion; kUndecodable: damaged, naming
//          what is wrong and where. Hostile bytes never crash nor take more memory than the
//          limit and one frame's chain.
// Threads  const-thread-safe; two that want the same layer decode it once.
// Source   sec. 5.2.4 [working storage].
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/core/result.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

class DecodedCache;
struct MrvFront;

class MrvClip final : public TimeTree {
  public:
    // `file` must stay mapped while the clip lives. `cache_bytes` bounds the layers that are
    // kept although no Frame holds on to them.
    [[nodiscard]] static Result<std::unique_ptr<MrvClip>> open(
        std::span<const std::byte> file,
        std::size_t cache_bytes);
    // The same with a cache that other clips use, too: its limit is theirs together.
    [[nodiscard]] static Result<std::unique_ptr<MrvClip>> open(
        std::span<const std::byte> file,
        std::shared_ptr<DecodedCache> cache);
    ~MrvClip() override;

    [[nodiscard]] bool stored(const SiblingAddress& address) const override;
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override;
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int space_level) const override;
    [[nodiscard]] int depth(const SiblingAddress& address) const override;
    [[nodiscard]] Result<Frame::Nodes> nodes_on_way(const SiblingAddress& address,
                                                    int time_level) const override;
    [[nodiscard]] Result<Frame::LayerPtr> layer_on_way(const SiblingAddress& address,
                                                       int time_level,
                                                       int space_level) const override;

    // What an append goes on from (mrv_writer.h).
    [[nodiscard]] const MrvFront& front() const;
    [[nodiscard]] std::uint64_t revision() const;
    // Of the cache, whoever shares it.
    [[nodiscard]] std::size_t cached_bytes() const;
    // How many chunks of this clip were decoded since open().
    [[nodiscard]] std::uint64_t decoded_chunks() const;
    // What all of the file takes when it is decoded, time-ancestors of older generations
    // included. Decodes it.
    [[nodiscard]] Result<std::uint64_t> memory_bytes() const;
    // Every chunk read and checked: what a clip from elsewhere must pass before it is kept.
    [[nodiscard]] Result<void> verify() const;

  private:
    class Impl;
    explicit MrvClip(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::video
