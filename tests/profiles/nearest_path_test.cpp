// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/nearest_path.h"

#include "pipelines/profiles/glob.h"

#include <gtest/gtest.h>
#include <vector>

namespace hearth::profiles
{

TEST(NearestPath, isReachedByTheLeastChangeOfThePattern)
{
    const std::vector<std::string> paths{"assets/characters/hero.glb", "assets/props/chair.gltf",
                                         "assets/props/old/Table.glb", "assets/rocks/rock.obj"};
    struct Row
    {
        const char* pattern;
        const char* path;
        const char* nearest; ///< pattern
    };
    for (const Row& row : {
             Row{"props/**/*.glb", "assets/props/old/Table.glb", "assets/props/**/*.glb"},
             Row{"props/*.glb", "assets/props/chair.gltf", "assets/props/*.gl*"},
             Row{"props/**", "assets/props/chair.gltf", "assets/props/**"},
             Row{"game/assets/props/**", "assets/props/chair.gltf", "assets/props/**"},
             Row{"assets/porps/**/*.gltf", "assets/props/chair.gltf", "assets/props/**/*.gltf"},
             Row{"./assets/rocks/*", "assets/rocks/rock.obj", "assets/rocks/*"},
             Row{"/assets/rocks/*", "assets/rocks/rock.obj", "assets/rocks/*"},
             Row{"assets\\props\\*", "assets/props/chair.gltf", "assets/props/*"},
             Row{"hero.glb", "assets/characters/hero.glb", "assets/characters/hero.glb"},
             Row{"assets/rocks/*.ply", "assets/rocks/rock.obj", "assets/rocks/*.obj"},
             Row{"assets/props/tabel.glb", "assets/props/old/Table.glb", ""},
         })
    {
        const std::optional<NearestPath> nearest = nearestPath(row.pattern, paths);
        ASSERT_TRUE(nearest) << row.pattern;
        EXPECT_EQ(nearest->path, row.path) << row.pattern;
        EXPECT_EQ(nearest->pattern, row.nearest) << row.pattern;
        EXPECT_TRUE(nearest->pattern.empty() || matchesPath(nearest->pattern, nearest->path)) << row.pattern;
    }
    EXPECT_FALSE(nearestPath("props/**", {}));
}

} // namespace hearth::profiles
