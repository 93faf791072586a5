/// Which of Fresnel's equations the values that somebody set are meant for.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "shading/fresnel.hpp"

namespace lobe::shading {
namespace {

FresnelType after(FresnelType present, const std::vector<std::string>& named,
                  const std::string& choice = {}) {
    return fresnelTypeFor(present, named, choice, "test");
}

TEST(FresnelTypeFor, AValuePutsInUseWhatReadsIt) {
    using enum FresnelType;
    EXPECT_EQ(after(schlick, {"m"}), schlick);
    EXPECT_EQ(after(conductor, {"m"}), conductor);
    EXPECT_EQ(after(schlick, {"eta"}), dielectric);
    EXPECT_EQ(after(conductor, {"eta"}), conductor);
    EXPECT_EQ(after(schlick, {"eta", "k"}), conductor);
    EXPECT_EQ(after(dielectric, {"k"}), conductor);
    EXPECT_EQ(after(conductor, {"f0"}), schlick);
    EXPECT_EQ(after(schlick, {"metal"}), conductor);
    EXPECT_EQ(after(conductor, {"fresnel", "eta"}, "dielectric"), dielectric);
}

TEST(FresnelTypeFor, ContradictionsAreRefused) {
    for (const std::vector<std::string>& named : {std::vector<std::string>{"metal", "eta"},
                                                  {"metal", "f0"},
                                                  {"metal", "fresnel"},
                                                  {"f0", "eta"},
                                                  {"f0", "k"}})
        EXPECT_THROW(after(FresnelType::schlick, named, "conductor"), UsageError) << named[1];
    EXPECT_THROW(after(FresnelType::schlick, {"fresnel", "eta"}, "schlick"), UsageError);
    EXPECT_THROW(after(FresnelType::schlick, {"fresnel", "k"}, "dielectric"), UsageError);
    EXPECT_THROW(after(FresnelType::schlick, {"fresnel", "f0"}, "conductor"), UsageError);
}

}  // namespace
}  // namespace lobe::shading
