// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/topology/self_intersections.h"

#include "cook/tools/child_processes.h"
#include "formats/base/regular_file.h"
#include "pipelines/command/shell/run_programs.h"

#include <filesystem>

namespace hearth::command
{

namespace
{

// Seconds of processor time. A scan of 1.6 million triangles takes about five; a tangle of a hundred thousand
// that all intersect would take most of an hour, and nobody reads a list of so many pairs.
constexpr const char* kMaxSeconds = "60";

SelfIntersections readMesh(const Json& json)
{
    SelfIntersections found;
    found.triangle_pairs = json["intersecting_triangle_pairs"].get<uint64_t>();
    for (const Json& pair : json["pairs"])
        found.pairs.push_back({pair[0].get<uint32_t>(), pair[1].get<uint32_t>()});
    return found;
}

} // namespace

SelfIntersectionCheck findSelfIntersections(const std::string& part, const std::string& folder,
                                            const std::string& subject)
{
    SelfIntersectionCheck check;
    std::error_code error;
    if (!std::filesystem::exists(tools::programFolder() + "/hearth-wrap", error))
    {
        check.not_checked = "hearth-wrap is not installed";
        return check;
    }
    const std::string output = folder + "/intersections.json";
    if (const auto failure = runPrograms(
            {{"wrap", subject, {part, "--self-intersections", output, "--max-seconds", kMaxSeconds}}}))
    {
        check.not_checked = failure->error;
        check.is_interrupted = failure->exit_code == kInterrupted;
        return check;
    }
    const Result<std::string> text = readFile(output);
    const std::optional<Json> json = text.ok() ? Json::parse(*text) : std::nullopt;
    try
    {
        if (!json)
            check.not_checked = "hearth-wrap wrote no JSON";
        else
            for (const Json& mesh : (*json)["meshes"])
                check.meshes[mesh["mesh"].get<uint32_t>()] = readMesh(mesh);
    }
    catch (const JsonError& wrong)
    {
        check.not_checked = std::string("hearth-wrap wrote other JSON than expected: ") + wrong.what();
    }
    return check;
}

} // namespace hearth::command
