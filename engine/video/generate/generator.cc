#include "engine/video/generate/generator.h"

#include <algorithm>
#include <string>

#include "engine/video/generate/fluid.h"
#include "engine/video/generate/galaxy.h"
#include "engine/video/generate/julia.h"
#include "engine/video/generate/panorama.h"
#include "engine/video/generate/room.h"
#include "engine/video/generate/wind.h"

namespace haarmony::video {
namespace {

using Maker = Result<std::unique_ptr<FrameSource>> (*)(const Recipe&);

struct Generator {
    std::int32_t width;
    std::int32_t height;
    std::int64_t frames;
    std::int32_t most;  // of either side; less where there is detail everywhere
    Maker make;
};

// As kGeneratorNames.
constexpr std::array<Generator, kGeneratorNames.size()> kGenerators = {{
    {256, 256, 64, 16'384, julia_frames},
    {1024, 1024, 128, 65'536, galaxy_frames},
    {256, 256, 128, 4'096, fluid_frames},
    {64, 64, 128, 2'048, wind_frames},
    {512, 512, 64, 16'384, room_frames},
    {2048, 512, 64, 16'384, panorama_frames},
}};

Error outside(const char* param,
              std::int64_t value,
              std::int64_t least,
              std::int64_t most) {
    return {ErrorCode::kInvalidArgument,
            std::string(param) + " is " + std::to_string(value) + "; want " +
                std::to_string(least) + " to " + std::to_string(most),
            param};
}

// A side as asked for, or in the generator's own proportion to the other one.
std::int64_t side(std::int32_t asked,
                  std::int32_t own,
                  std::int32_t other_asked,
                  std::int32_t other_own) {
    if (asked != 0) return asked;
    if (other_asked == 0) return own;
    return std::max<std::int64_t>(1, std::int64_t{other_asked} * own / other_own);
}

Result<Recipe> recipe_of(const Generator& generator, const GeneratorParameters& wanted) {
    const std::int64_t width =
        side(wanted.width, generator.width, wanted.height, generator.height);
    const std::int64_t height =
        side(wanted.height, generator.height, wanted.width, generator.width);
    if (width < kMinGeneratedSide || width > generator.most) {
        return outside("width", width, kMinGeneratedSide, generator.most);
    }
    if (height < kMinGeneratedSide || height > generator.most) {
        return outside("height", height, kMinGeneratedSide, generator.most);
    }
    const std::int64_t frames = wanted.frames == 0 ? generator.frames : wanted.frames;
    if (frames < 1 || frames > kMaxGeneratedFrames) {
        return outside("frames", frames, 1, kMaxGeneratedFrames);
    }
    const Result<ClipShape> shape = ClipShape::make({static_cast<std::int32_t>(width),
                                                     static_cast<std::int32_t>(height),
                                                     wanted.rate},
                                                    frames);
    if (!shape) return shape.error();
    const int depth = wanted.depth.value_or((*shape).space_levels());
    if (depth < kBrickLevel || depth > (*shape).space_levels()) {
        return outside("depth", depth, kBrickLevel, (*shape).space_levels());
    }
    return Recipe{(*shape).format(), frames, depth, wanted.seed};
}

}  // namespace

Result<std::unique_ptr<FrameSource>> make_generator(
    std::string_view name,
    const GeneratorParameters& parameters) {
    std::string all;
    for (std::size_t i = 0; i < kGeneratorNames.size(); ++i) {
        if (kGeneratorNames[i] != name) {
            all += (all.empty() ? "" : ", ") + std::string(kGeneratorNames[i]);
            continue;
        }
        const Result<Recipe> recipe = recipe_of(kGenerators[i], parameters);
        if (!recipe) return recipe.error();
        return kGenerators[i].make(*recipe);
    }
    return Error{ErrorCode::kInvalidArgument,
                 "generate is '" + std::string(name) + "'; want one of " + all,
                 "generate"};
}

}  // namespace haarmony::video
