// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/nearest_match.h"

#include <gtest/gtest.h>

namespace hearth::tools
{

TEST(EditDistance, countsEachKindOfSlipOnce)
{
    EXPECT_EQ(editDistance("cook", "cook"), 0u);
    EXPECT_EQ(editDistance("cok", "cook"), 1u);
    EXPECT_EQ(editDistance("coook", "cook"), 1u);
    EXPECT_EQ(editDistance("cool", "cook"), 1u);
    EXPECT_EQ(editDistance("ocok", "cook"), 1u);
    EXPECT_EQ(editDistance("", "cook"), 4u);
    EXPECT_EQ(editDistance("inspect", "verify"), editDistance("verify", "inspect"));
}

TEST(NearestMatch, findsWhatWasMeant)
{
    const std::string verbs[] = {"cook", "inspect", "verify"};
    EXPECT_EQ(nearestMatch("cokk", verbs), "cook");
    EXPECT_EQ(nearestMatch("inpsect", verbs), "inspect");
    EXPECT_EQ(nearestMatch("verfy", verbs), "verify");
}

TEST(NearestMatch, keepsQuietWhereNothingIsNear)
{
    const std::string verbs[] = {"cook", "inspect"};
    EXPECT_EQ(nearestMatch("paint", verbs), "");
    EXPECT_EQ(nearestMatch("", verbs), "");
    EXPECT_EQ(nearestMatch(std::string(100000, 'c'), verbs), "");
}

} // namespace hearth::tools
