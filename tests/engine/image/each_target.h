// Runs a check once for each instruction set that was compiled and that this machine has,
// plain C++ among them.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <functional>

namespace haarmony::image {

inline void for_each_target(const std::function<void(const char* name)>& check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        check(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace haarmony::image
