// What the tests on the device share: the device, the views that are drawn, and that validation stays silent.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/culling/culling_oracle.h"
#include "tests/roundtrip/cooked_sample.h"
#include "tests/roundtrip/gpu_draw.h"

#include <gtest/gtest.h>

namespace hearth::roundtrip
{

/// Skips where there is no device, and fails after each test where the validation layers said anything.
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

/// A view of a sample that is worth a test.
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

/// From outside, from within, close to a surface that crosses the near plane, far away, tall, tiny, and at an angle.
std::vector<NamedView> viewsOf(const formats::PackView& pack);

/// Small samples that between them have every kind of instance, material and mesh.
std::vector<SampleSpec> drawnSamples();

} // namespace hearth::roundtrip
