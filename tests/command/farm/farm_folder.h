// Sources, and the steps of a distributed build of them, with the real hearth and all its cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hearth::test
{

class Farm : public ::testing::Test
{
protected:
    Farm();

    ProgramEnd hearthIn(Sandbox& place, const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment = {});

    ProgramEnd hearth(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment = {});

    /// Run a verb over all sources.
    ProgramEnd over(const std::string& verb, const std::vector<std::string>& options,
                    const std::vector<std::string>& more = {});

    /// Plan all sources; return the plan's text.
    std::string plan(size_t shards, const std::vector<std::string>& options = {});

    /// Return the pack that a cook on this machine makes.
    std::string localPack(const std::vector<std::string>& options = {});

    ProgramEnd run(size_t shard, size_t count, const std::vector<std::string>& more = {});

    /// Prepare all shards of the plan, last first.
    void prepareAll(size_t count);

    /// Return the pack that the merge makes.
    std::string merged();

    /// Make three sources that stand side by side, and one far away, the cook's sources.
    void placeSources();

    /// Empty the cache.
    void forget();

    Sandbox folder;
    std::vector<std::string> sources{"house.obj", "tree.gltf", "barn.obj", "bush.gltf"};

    /// Options of a cook in which sources occlude each other.
    const std::vector<std::string> occlusion{"--visibility", "--visibility-quality", "draft"};
};

} // namespace hearth::test
