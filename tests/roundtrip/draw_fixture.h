// Fixture of the tests on the device: creates the device, provides the views, and checks that validation
// stays silent.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/culling/culling_oracle.h"
#include "tests/roundtrip/cooked_sample.h"
#include "tests/roundtrip/gpu_draw.h"

#include <gtest/gtest.h>

namespace hearth::roundtrip
{

/// Skips if there is no device, and fails after each test if the validation layers reported anything.
class DrawTest : public testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void SetUp() override;
    void TearDown() override;

    static TestDevice& device() { return *device_; }

private:
    static std::unique_ptr<TestDevice> device_;
    static std::string no_device_;
};

/// A view of a sample, with the name of its case.
struct NamedView
{
    std::string name;
    reference::OracleView view;

    shared::FrameView frame(const formats::PackView& pack) const
    {
        return shared::makeFrameView(view.camera, view.width, view.height, view.error_pixels,
                                     static_cast<uint32_t>(pack.instances().size()), view.flags);
    }
};

/// Views from outside, from within, close to a surface that crosses the near plane, far away, tall, tiny, and
/// at an angle.
std::vector<NamedView> makeViews(const formats::PackView& pack);

/// Small samples that together have every kind of instance, material and mesh.
std::vector<SampleSpec> drawnSamples();

} // namespace hearth::roundtrip
