// Stands for the tests of hearth-wrap where it is not built.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include <gtest/gtest.h>

namespace
{

TEST(WrapMesh, IsNotBuilt)
{
    GTEST_SKIP()
        << "hearth-wrap is not built: CGAL is not installed, HEARTH_BUILD_WRAP is off, or a sanitizer is on";
}

} // namespace
