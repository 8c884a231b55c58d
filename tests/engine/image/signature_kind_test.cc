#include "engine/image/signature_kind.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/engine/image/all_kinds.h"

namespace haarmony::image {
namespace {

TEST(SignatureKind, NamesAreThoseOfTheInterface) {
    std::string names;
    for (const SignatureKind& kind : all_kinds()) names += kind_name(kind) + " ";
    EXPECT_EQ(names,
              "yiq-standard yiq-nonstandard rgb-standard rgb-nonstandard "
              "hsv-standard hsv-nonstandard lab-standard lab-nonstandard "
              "luv-standard luv-nonstandard ");
}

TEST(SignatureKind, IsReadBackFromItsName) {
    for (const SignatureKind& kind : all_kinds()) {
        EXPECT_EQ(kind_from_name(kind_name(kind)), kind) << kind_name(kind);
        EXPECT_EQ(color_space_from_name(color_space_name(kind.color_space)),
                  kind.color_space);
        EXPECT_EQ(decomposition_from_name(decomposition_name(kind.decomposition)),
                  kind.decomposition);
    }
}

TEST(SignatureKind, IsNotReadFromAnyOtherName) {
    for (const char* name : {"",
                             "-",
                             "yiq",
                             "yiq-",
                             "-standard",
                             "standard-yiq",
                             "YIQ-standard",
                             "yiq-standard ",
                             "yiq-standard-",
                             "yiq_standard",
                             "xyz-standard",
                             "yiq-square"}) {
        EXPECT_EQ(kind_from_name(name), std::nullopt) << name;
    }
    EXPECT_EQ(color_space_from_name("standard"), std::nullopt);
    EXPECT_EQ(decomposition_from_name("yiq"), std::nullopt);
}

TEST(SignatureKind, IsYiqStandardUnlessSaidOtherwise) {
    EXPECT_EQ(kind_name(SignatureKind{}), "yiq-standard");
}

TEST(SignatureKind, IsOrderedSoThatASetHoldsEachOnce) {
    const std::vector<SignatureKind> kinds = all_kinds();
    std::set<SignatureKind> set(kinds.begin(), kinds.end());
    set.insert(kinds.begin(), kinds.end());
    EXPECT_EQ(set.size(), 10U);
}

}  // namespace
}  // namespace haarmony::image
