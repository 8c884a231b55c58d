#include "tests/engine/video/ops/source_pictures.h"

#include <gtest/gtest.h>

#include "engine/video/tree_writer.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video::testing {

std::vector<Picture> pictures_of(FrameSource& source) {
    std::vector<Picture> pictures;
    SourceFrame frame;
    for (;;) {
        const Result<bool> more = source.next(frame);
        EXPECT_TRUE(more.has_value());
        if (!more || !*more) return pictures;
        EXPECT_GE(frame.repeats, 1);
        pictures.insert(pictures.end(),
                        static_cast<std::size_t>(frame.repeats),
                        picture_of(frame.tree, source.format()));
    }
}

Result<bool> GreyFrames::next(SourceFrame& frame) {
    if (next_ == frames_ && fails_) return Error{ErrorCode::kIo, "the disk is gone"};
    if (next_ == frames_) return false;
    const auto shade = static_cast<std::uint8_t>(10 * next_++);
    TreePart grey;
    grey.pixels.fill({shade, shade, shade, 255});
    TreeWriter(frame.tree).finish(grey);
    frame.repeats = 1;
    return true;
}

}  // namespace haarmony::video::testing
