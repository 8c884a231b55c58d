#include "engine/image/area_mean.h"

#include <cassert>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/image/area_mean.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void Divide(std::span<const std::uint32_t> sums, double scale, float* HWY_RESTRICT out) {
    const hn::ScalableTag<double> d;
    const hn::Rebind<std::int32_t, decltype(d)> d_int;
    const hn::Rebind<float, decltype(d)> d_float;
    const auto divisor = hn::Set(d, scale);
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= sums.size(); i += lanes) {
        const auto sum =
            hn::LoadU(d_int, reinterpret_cast<const std::int32_t*>(sums.data() + i));
        const auto quotient = hn::Div(hn::PromoteTo(d, sum), divisor);
        hn::StoreU(hn::DemoteTo(d_float, quotient), d_float, out + i);
    }
    for (; i < sums.size(); ++i) out[i] = static_cast<float>(sums[i] / scale);
}

void ScaleToBytes(std::span<const std::uint32_t> sums, float scale, std::uint8_t* out) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> d_int;
    const hn::Rebind<std::uint8_t, decltype(d)> d8;
    const auto factor = hn::Set(d, scale);
    const auto half = hn::Set(d, 0.5F);
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= sums.size(); i += lanes) {
        const auto sum =
            hn::LoadU(d_int, reinterpret_cast<const std::int32_t*>(sums.data() + i));
        const auto scaled = hn::Add(hn::Mul(hn::ConvertTo(d, sum), factor), half);
        hn::StoreU(hn::DemoteTo(d8, hn::ConvertTo(d_int, scaled)), d8, out + i);
    }
    for (; i < sums.size(); ++i) {
        const float scaled =
            static_cast<float>(static_cast<std::int32_t>(sums[i])) * scale + 0.5F;
        out[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(scaled));
    }
}

void TakeApart(std::span<const float> interleaved,
               float* red,
               float* green,
               float* blue) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t count = interleaved.size() / 3;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        hn::Vec<decltype(d)> r, g, b;
        hn::LoadInterleaved3(d, interleaved.data() + 3 * i, r, g, b);
        hn::StoreU(r, d, red + i);
        hn::StoreU(g, d, green + i);
        hn::StoreU(b, d, blue + i);
    }
    for (; i < count; ++i) {
        red[i] = interleaved[3 * i];
        green[i] = interleaved[3 * i + 1];
        blue[i] = interleaved[3 * i + 2];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {
namespace {

HWY_EXPORT(Divide);
HWY_EXPORT(ScaleToBytes);
HWY_EXPORT(TakeApart);

}  // namespace

void divide(std::span<const std::uint32_t> sums, double scale, std::span<float> out) {
    assert(out.size() == sums.size());
    HWY_DYNAMIC_DISPATCH(Divide)(sums, scale, out.data());
}

void scale_to_bytes(std::span<const std::uint32_t> sums,
                    float scale,
                    std::span<std::uint8_t> out) {
    assert(out.size() == sums.size());
    HWY_DYNAMIC_DISPATCH(ScaleToBytes)(sums, scale, out.data());
}

void take_apart(std::span<const float> interleaved,
                std::span<float> red,
                std::span<float> green,
                std::span<float> blue) {
    assert(interleaved.size() == 3 * red.size());
    assert(green.size() == red.size() && blue.size() == red.size());
    HWY_DYNAMIC_DISPATCH(TakeApart)
    (interleaved, red.data(), green.data(), blue.data());
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
