// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/command/farm/farm_folder.h"

#include "tests/support/small_sources.h"

#include <filesystem>
#include <utility>

namespace hearth::test
{

namespace fs = std::filesystem;

Farm::Farm()
{
    writeObj(folder, "house");
    writeObj(folder, "barn", 2, 60);
    writeGltf(folder, "tree");
    writeGltf(folder, "bush", 0.5F);
}

ProgramEnd Farm::hearthIn(Sandbox& place, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment)
{
    std::vector<std::string> command{HEARTH_BIN "/hearth"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return place.run(command, environment);
}

ProgramEnd Farm::hearth(const std::vector<std::string>& arguments,
                        const std::vector<std::string>& environment)
{
    return hearthIn(folder, arguments, environment);
}

ProgramEnd Farm::over(const std::string& verb, const std::vector<std::string>& options,
                      const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{verb};
    arguments.insert(arguments.end(), sources.begin(), sources.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hearth(withoutLightCookers(std::move(arguments)));
}

std::string Farm::plan(size_t shards, const std::vector<std::string>& options)
{
    const ProgramEnd end =
        over("plan", {"-o", "plan.json", "-q", "--shards", std::to_string(shards)}, options);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return folder.read("plan.json");
}

std::string Farm::localPack(const std::vector<std::string>& options)
{
    EXPECT_EQ(over("cook", {"-o", "local.hearth", "-q", "--no-cache"}, options).exit_code, 0);
    return folder.read("local.hearth");
}

ProgramEnd Farm::run(size_t shard, size_t count, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments{"run", "plan.json", "--shard",
                                       std::to_string(shard) + "/" + std::to_string(count)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hearth(arguments);
}

void Farm::prepareAll(size_t count)
{
    for (size_t shard = count; shard-- > 0;)
    {
        const ProgramEnd end = run(shard, count, {"--prepare"});
        EXPECT_EQ(end.exit_code, 0) << end.err;
    }
}

void Farm::placeSources()
{
    sources.clear();
    for (const auto& [name, x] : std::vector<std::pair<std::string, std::string>>{
             {"a", "0"}, {"b", "1.5"}, {"c", "3"}, {"far", "500"}})
    {
        writeGltf(folder, name);
        std::string text = folder.read(name + ".gltf");
        replaceAll(text, R"({"mesh":0})",
                   R"({"mesh":0,"rotation":[0,0.7071068,0,0.7071068],"translation":[)" + x + ",0,0]}");
        folder.write(name + ".gltf", text);
        sources.push_back(name + ".gltf");
    }
}

std::string Farm::merged()
{
    fs::remove(folder / "farm.hearth");
    const ProgramEnd end = hearth({"merge", "plan.json", "-o", "farm.hearth"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return folder.read("farm.hearth");
}

void Farm::forget()
{
    fs::remove_all(folder.cachePath());
}

} // namespace hearth::test
