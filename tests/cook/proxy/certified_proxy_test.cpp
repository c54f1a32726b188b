// Checks what proxy parts state with the means of others: distances by CGAL, manifolds by counting.
// `./dev bench proxies` does it for all real models.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/proxies/proxy_check.h"
#include "tests/support/sandbox.h"
#include "tests/support/surfaces/cgal_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace hearth::test
{

namespace
{

/// Part of the diagonal that CGAL's distances may be off by.
constexpr double kError = 1e-3;

class CertifiedProxy : public ::testing::Test
{
protected:
    void run(std::vector<std::string> words)
    {
        words.front() = std::string(HEARTH_BIN) + "/" + words.front();
        const ProgramEnd end = folder.run(words);
        ASSERT_EQ(end.exit_code, 0) << end.err;
    }

    /// Make the parts of a model by the real programs.
    /// triangles  as hearth-proxy's
    ProxyParts makeParts(const std::string& source, const std::string& triangles)
    {
        run({"hearth-import", source, "-o", "a.import.part"});
        run({"hearth-clusters", "a.import.part", "-o", "a.clusters.part"});
        run({"hearth-proxy", "a.import.part", "a.clusters.part", "-o", "a.proxy.part", "--bindings",
             "--triangles", triangles});
        return openProxyParts(folder / "a").value();
    }

    /// Make the parts of a generated sample, whose proxies are simpler than by default.
    ProxyParts makeSample(const std::string& name, const std::string& triangles)
    {
        run({"hearth-samples", name, "--triangles", triangles, "--texture-size", "1", "-o", "sample.glb"});
        return makeParts("sample.glb", "500");
    }

    void expectCertified(const ProxyParts& parts)
    {
        ASSERT_GT(parts.proxy_part.proxies().size(), 0u);
        for (size_t i = 0; i < parts.proxy_part.proxies().size(); ++i)
        {
            const CheckedProxy proxy = readProxy(parts, i).value();
            SCOPED_TRACE("proxy " + std::to_string(i) + " of " + proxy.mesh.name);
            EXPECT_EQ(findShapeDefect(proxy), "");
            EXPECT_EQ(findBindingDefect(parts, proxy).value(), "");
            const double error = kError * proxy.diagonal();
            const double to_mesh = cgalDistance(proxy.surface, proxy.meshSurface(), error);
            const double to_proxy = cgalDistance(proxy.meshSurface(), proxy.surface, error);
            EXPECT_LE(to_mesh - error, proxy.record.distance + proxy.rounding());
            EXPECT_LE(to_proxy - error, proxy.record.mesh_distance + proxy.rounding());
            EXPECT_LE(proxy.record.distance, 1.1 * (to_mesh + error));
            EXPECT_LE(proxy.record.mesh_distance, 1.1 * (to_proxy + error));
        }
    }

    Sandbox folder;
};

} // namespace

TEST_F(CertifiedProxy, ofSamples)
{
    expectCertified(makeSample("rock", "6000"));
    expectCertified(makeSample("room", "1000"));
}

TEST_F(CertifiedProxy, ofRealModels)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name the folder of the asset corpus";
    for (const char* const model : {"skinned/fox/Fox.glb"})
    {
        SCOPED_TRACE(model);
        expectCertified(makeParts(std::string(assets) + "/good/" + model, "100000"));
    }
}

TEST_F(CertifiedProxy, isRefusedWithAnyOtherStatement)
{
    const ProxyParts parts = makeSample("rock", "6000");
    CheckedProxy proxy = readProxy(parts, 0).value();
    const double error = kError * proxy.diagonal();
    EXPECT_GT(cgalDistance(proxy.surface, proxy.meshSurface(), error) - error, 0.8 * proxy.record.distance)
        << "a bound that is a fifth too small is noticed";

    proxy.record.is_closed = 1 - proxy.record.is_closed;
    EXPECT_NE(findShapeDefect(proxy), "");
    proxy.record.is_closed = 1 - proxy.record.is_closed;
    std::vector<uint32_t> triangles(proxy.surface.triangles.begin(), proxy.surface.triangles.end());
    std::swap(triangles[0], triangles[1]);
    const std::span<const uint32_t> stored = std::exchange(proxy.surface.triangles, triangles);
    EXPECT_NE(findShapeDefect(proxy), "") << "a triangle is turned";
    proxy.surface.triangles = stored;
    EXPECT_EQ(findShapeDefect(proxy), "");

    std::vector<formats::ProxyBindingRecord> bindings(proxy.bindings.begin(), proxy.bindings.end());
    bindings.back().distance += static_cast<float>(1e-3 * proxy.diagonal());
    const std::span<const formats::ProxyBindingRecord> all = std::exchange(proxy.bindings, bindings);
    EXPECT_NE(findBindingDefect(parts, proxy).value(), "") << "a place is nearer than stated";
    proxy.bindings = all.first(all.size() - 1);
    EXPECT_NE(findBindingDefect(parts, proxy).value(), "") << "a vertex is not bound";
    proxy.bindings = all;
    EXPECT_EQ(findBindingDefect(parts, proxy).value(), "");
}

} // namespace hearth::test
