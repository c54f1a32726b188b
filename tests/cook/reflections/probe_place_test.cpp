// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/place/probe_place.h"

#include <gtest/gtest.h>

namespace hearth::reflections
{

TEST(ProbePlace, isAPointABoxAndAFade)
{
    const ProbePlace point = parseProbePlace("1,-1.5,2e1").value();
    EXPECT_EQ(point.position, (Float3{1, -1.5f, 20}));
    EXPECT_FALSE(point.box || point.fade);
    const ProbePlace boxed = parseProbePlace("1,1,1:0,0,0:4,3,5").value();
    EXPECT_EQ(boxed.box->min, Float3{});
    EXPECT_EQ(boxed.box->max, (Float3{4, 3, 5}));
    EXPECT_FALSE(boxed.fade);
    EXPECT_EQ(parseProbePlace("1,1,1:0,0,0:4,3,5:0.5").value().fade, 0.5f);
}

TEST(ProbePlace, saysWhatIsWrong)
{
    for (const char* text :
         {"", "1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1,2,1e7", "1,1,1:0,0,0", "1,1,1:", "1,1,1:2,0,0:4,3,5",
          "1,1,1:0,0,0:1,3,5", "1,1,1:0,0,0:4,3,5:0", "1,1,1:0,0,0:4,3,5:-1", "1,1,1:0,0,0:4,3,5:1:1"})
    {
        const auto place = parseProbePlace(text);
        ASSERT_FALSE(place.ok()) << text;
        EXPECT_EQ(place.error().issue, Issue::usage);
        EXPECT_EQ(place.error().where, text);
    }
}

} // namespace hearth::reflections
