// Fixture of tests on a renderer that has all light methods.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/gpu_fixture.h"

namespace hearth::test
{

class AllLightsTest : public GpuTest
{
protected:
    static void SetUpTestSuite()
    {
        GpuTest::SetUpTestSuite();
        gpu::RendererOptions options = testRendererOptions();
        options.deferred = true;
        replaceRenderer(options);
    }
};

} // namespace hearth::test
