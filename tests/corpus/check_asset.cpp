// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/corpus/check_asset.h"

#include "cook/json/json.h"
#include "tests/corpus/open_log.h"
#include "tests/corpus/read_text.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace hearth::corpus
{

namespace
{

namespace fs = std::filesystem;

// Programs that inspect an existing pack have no limit of the asset's; this one detects hangs.
constexpr Limits kLookLimits{120, uint64_t{4} << 30};

// Baking what each vertex sees takes seconds for each hundred thousand triangles.
constexpr uint64_t kMaxBakedTriangles = 50'000;

// Wraps take as long as their surfaces are large, over alpha: this runs all of the code in a few hundredths
// of the time.
constexpr const char* kWrapOptions[] = {"--alpha", "0.2", "--offset", "0.02"};
constexpr uint64_t kMaxWrappedTriangles = 50'000;

constexpr size_t kReportedLines = 3;
constexpr size_t kMaxMessages = size_t{16} << 20;

/// Folders and files of one check: the programs see only the box; the rest lies beside it.
struct Workplace
{
    std::string box;
    std::string pack;
    std::string image;
    std::string stdout_file;
    std::string stderr_file;
    std::string open_log;
    std::string drawing_box;

    explicit Workplace(const std::string& folder)
        : box(folder + "/box"),
          pack(box + "/asset.hearth"),
          image(folder + "/drawing/asset.png"),
          stdout_file(folder + "/stdout"),
          stderr_file(folder + "/stderr"),
          open_log(folder + "/open.log"),
          drawing_box(folder + "/drawing")
    {
        fs::create_directory(box);
        fs::create_directory(drawing_box);
    }

    /// Remove all contents, so that the folder is ready for the next check.
    ~Workplace()
    {
        std::error_code ignored;
        for (const std::string& path : {box, drawing_box, stdout_file, stderr_file, open_log})
            fs::remove_all(path, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
};

ProcessEnd run(const Workplace& place, std::vector<std::string> arguments, const Limits& limits,
               const std::string& folder, std::vector<std::string> environment = {})
{
    environment.push_back("TMPDIR=" + folder);
    // the cookers run in the asset's own folder
    environment.push_back("HEARTH_CACHE=off");
    return runProcess(
        {std::move(arguments), std::move(environment), folder, place.stdout_file, place.stderr_file}, limits);
}

/// Return the triangles that the manifest says; 0 for malformed assets, which are small.
uint64_t countTriangles(const Asset& asset)
{
    const auto triangles = asset.counts.find("triangles");
    return triangles == asset.counts.end() ? 0 : triangles->second;
}

ProcessEnd cook(const Workplace& place, const Asset& asset, const Programs& programs)
{
    const std::string library =
        fs::read_symlink("/proc/self/exe").parent_path().string() + "/" + kOpenLogLibrary;
    // coarse textures and bricks go through the same code as fine ones, and so does baking of small models
    std::vector<std::string> command = {programs.hearth, "cook",           asset.path, "-o",
                                        place.pack,      "--proxy-from",   "clean",    "--texture-quality",
                                        "draft",         "--brick-memory", "1M"};
    if (!asset.counts.contains("width"))
        command.insert(command.end(), {"--max-texture-size", "512"});
    if (countTriangles(asset) > kMaxBakedTriangles)
        command.insert(command.end(), {"--visibility", "off"});
    return run(place, std::move(command), asset.limits, place.box,
               {"LD_PRELOAD=" + library, std::string(kOpenLogVariable) + "=" + place.open_log,
                // otherwise a program under AddressSanitizer refuses to start after a preloaded library
                "ASAN_OPTIONS=verify_asan_link_order=0"});
}

// ---- messages

bool isError(const std::string& line)
{
    return line.find(": error:") != std::string::npos;
}

std::vector<std::string> errorLines(const std::string& messages)
{
    std::vector<std::string> lines = splitLines(messages);
    std::erase_if(lines, [](const std::string& line) { return !isError(line); });
    return lines;
}

/// Return the most informative lines: errors before warnings before the rest.
std::vector<std::string> tellingLines(const std::string& messages)
{
    std::vector<std::string> lines = splitLines(messages);
    const auto rank = [](const std::string& line)
    {
        if (isError(line))
            return 0;
        return line.find(": warning:") != std::string::npos ? 1 : 2;
    };
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
    lines.resize(std::min(lines.size(), kReportedLines));
    return lines;
}

std::string mostTellingLine(const std::string& messages)
{
    const std::vector<std::string> lines = tellingLines(messages);
    return lines.empty() ? "" : lines.front();
}

// ---- faults that no asset excuses

std::string seconds(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f s", value);
    return text;
}

std::string mebibytes(uint64_t bytes)
{
    return std::to_string(bytes >> 20) + " MiB";
}

void addEndFaults(std::vector<std::string>& faults, const std::string& program, const ProcessEnd& end,
                  const Limits& limits)
{
    if (!end.started)
        faults.push_back(program + " cannot be started");
    if (end.over_time)
        faults.push_back(program + " runs longer than " + seconds(limits.seconds));
    if (end.over_memory)
        faults.push_back(program + " needs more memory than " + mebibytes(limits.rss_bytes) + ": " +
                         mebibytes(end.peak_rss_bytes));
    if (end.over_time || end.over_memory)
        return;
    if (end.signal != 0)
        faults.push_back(program + " is ended by signal " + std::to_string(end.signal) + " (" +
                         ::strsignal(end.signal) + ")");
    if (end.left_processes)
        faults.push_back(program + " leaves processes running");
}

void addStreamFaults(std::vector<std::string>& faults, const Workplace& place, const std::string& messages)
{
    if (fs::file_size(place.stdout_file) != 0)
        faults.push_back("writes to stdout");
    if (std::any_of(messages.begin(), messages.end(), isControlCharacter))
        faults.push_back("control characters of the asset reach the terminal");
    if (messages.size() >= kMaxMessages)
        faults.push_back("floods stderr");
}

// ---- the two clean outcomes

std::vector<std::string> filesIn(const std::string& folder)
{
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        files.push_back(entry.path().lexically_relative(folder).string());
    std::sort(files.begin(), files.end());
    return files;
}

void addLeftovers(std::vector<std::string>& faults, const Workplace& place)
{
    for (const std::string& file : filesIn(place.box))
        if (place.box + "/" + file != place.pack)
            faults.push_back("leaves " + file + " behind");
}

void addRejectionFaults(std::vector<std::string>& faults, const Workplace& place, const Asset& asset,
                        const std::string& messages)
{
    const std::vector<std::string> errors = errorLines(messages);
    if (errors.size() != 1)
        faults.push_back("says " + std::to_string(errors.size()) + " error lines, not one");
    else if (errors[0].find(fs::path(asset.file).filename().string()) == std::string::npos)
        faults.push_back("the error does not name the file");
    if (fs::exists(place.pack))
        faults.push_back("leaves an output");
}

/// Run a program on the existing pack. returns whether all is well with it
bool look(std::vector<std::string>& faults, const std::string& name, const Workplace& place,
          std::vector<std::string> arguments, const std::string& folder)
{
    const size_t before = faults.size();
    const ProcessEnd end = run(place, std::move(arguments), kLookLimits, folder);
    addEndFaults(faults, name, end, kLookLimits);
    if (faults.size() == before && end.exit_code != 0)
        faults.push_back(name + " exits with " + std::to_string(end.exit_code) + ": " +
                         mostTellingLine(readText(place.stderr_file, kMaxMessages)));
    return faults.size() == before;
}

/// Return a count of the pack; 0 if the output does not have it.
uint64_t number(const Json& object, const char* name)
{
    const Json* found = object.find(name);
    return found != nullptr && found->is_number_unsigned() ? found->get<uint64_t>() : 0;
}

void compareCounts(std::vector<std::string>& faults, const Asset& asset, const Json& inspected)
{
    const Json& source = inspected.at("totals").at("source");
    const auto differs = [&](const std::string& name, uint64_t expected, uint64_t found)
    {
        faults.push_back("has " + std::to_string(found) + " " + name + ", the manifest says " +
                         std::to_string(expected));
    };
    for (const char* name : {"triangles", "faces", "vertices", "materials", "joints", "animations"})
    {
        const auto expected = asset.counts.find(name);
        if (expected == asset.counts.end())
            continue;
        // the manifest counts the polygons of a scan as its triangles
        const bool faces_do =
            std::string_view(name) == "triangles" && number(source, "faces") == expected->second;
        // note: "faces" of a texture are faces of a cube map; no scan has them beside a width
        if (!asset.counts.contains("vertices") && std::string_view(name) == "faces")
            continue;
        if (number(source, name) != expected->second && !faces_do)
            differs(name, expected->second, number(source, name));
    }
    const Json& images = inspected.at("scene").at("images");
    for (const char* name : {"width", "height"})
        if (const auto expected = asset.counts.find(name); expected != asset.counts.end())
            if (const uint64_t found = images.empty() ? 0 : number(images.at(0), name);
                found != expected->second)
                differs(name, expected->second, found);
}

void addCountFaults(std::vector<std::string>& faults, const Workplace& place, const Asset& asset,
                    const Programs& programs)
{
    if (!look(faults, "hearth inspect", place, {programs.hearth, "inspect", "--format", "json", place.pack},
              place.box))
        return;
    try
    {
        const Json inspected =
            Json::parse(readText(place.stdout_file, kMaxMessages)).value_or(Json::object());
        if (inspected.at("schema") != "hearth.inspect/1")
            faults.push_back("hearth inspect writes another schema");
        else
            compareCounts(faults, asset, inspected);
    }
    catch (const JsonError& error)
    {
        faults.push_back(std::string("hearth inspect writes what cannot be read: ") + error.what());
    }
}

void addDrawingFaults(std::vector<std::string>& faults, const Workplace& place, const Programs& programs)
{
    const std::vector<std::string> command = {programs.render, place.pack, "-o",    place.image,
                                              "--size",        "64x64",    "--fit", "--validate"};
    if (look(faults, "hearth-render", place, command, place.drawing_box) &&
        (!fs::exists(place.image) || fs::file_size(place.image) == 0))
        faults.push_back("hearth-render writes no image");
}

/// Write the pack as GLB and import that, with its proxies and, to wrap its meshes, without.
void addExportFaults(std::vector<std::string>& faults, const Workplace& place, const Asset& asset,
                     const Programs& programs)
{
    const auto succeeds = [&](const std::string& name, std::vector<std::string> command)
    { return look(faults, name, place, std::move(command), place.box); };
    if (!succeeds("hearth extract", {programs.hearth, "extract", place.pack, "-o", "asset.glb"}) ||
        !succeeds("hearth-import of the GLB", {programs.import, "asset.glb", "-o", "again.part"}))
        return;
    if (programs.wrap.empty() || countTriangles(asset) > kMaxWrappedTriangles)
        return;
    std::vector<std::string> wrap = {programs.wrap, "bare.part", "-o", "wrap.part"};
    wrap.insert(wrap.end(), std::begin(kWrapOptions), std::end(kWrapOptions));
    if (succeeds("hearth-import of the GLB",
                 {programs.import, "asset.glb", "-o", "bare.part", "--proxies", "off"}))
        succeeds("hearth-wrap", std::move(wrap));
}

void addPackFaults(std::vector<std::string>& faults, const Workplace& place, const Asset& asset,
                   const Programs& programs)
{
    if (!fs::is_regular_file(place.pack))
    {
        faults.push_back("exits with 0 and writes no pack");
        return;
    }
    look(faults, "hearth verify", place, {programs.hearth, "verify", place.pack}, place.box);
    addExportFaults(faults, place, asset, programs);
    if (!asset.expected->mustLoad())
        return;
    addCountFaults(faults, place, asset, programs);
    if (!programs.render.empty())
        addDrawingFaults(faults, place, programs);
}

Outcome getOutcome(int exit_code, const std::vector<std::string>& faults)
{
    if (!faults.empty())
        return Outcome::broken;
    return exit_code == 0 ? Outcome::loads : Outcome::rejects;
}

void addClassFault(Finding& finding, const AssetClass& expected)
{
    if (finding.outcome == Outcome::loads && !expected.may_load)
        finding.faults.push_back("loads, and should be rejected");
    if (finding.outcome == Outcome::rejects && !expected.may_reject)
        finding.faults.push_back("is rejected, and should load");
}

} // namespace

const char* outcomeName(Outcome outcome)
{
    switch (outcome)
    {
    case Outcome::loads:
        return "loads";
    case Outcome::rejects:
        return "rejects";
    case Outcome::broken:
        return "broken";
    }
    return "";
}

Finding checkAsset(const Asset& asset, const Programs& programs, const std::string& work)
{
    const auto begin = std::chrono::steady_clock::now();
    const Workplace place(work);
    const ProcessEnd end = cook(place, asset, programs);
    const std::string messages = readText(place.stderr_file, kMaxMessages);

    Finding finding;
    finding.exit_code = end.exit_code;
    finding.messages = tellingLines(messages);
    finding.cook_seconds = end.seconds;
    finding.peak_rss_bytes = end.peak_rss_bytes;
    addEndFaults(finding.faults, "hearth cook", end, asset.limits);
    const bool ended = finding.faults.empty();
    if (end.started)
        addStreamFaults(finding.faults, place, messages);
    const auto trespassed =
        trespasses(readOpenLog(place.open_log), asset.folder, place.box, programs.allowed);
    finding.faults.insert(finding.faults.end(), trespassed.begin(), trespassed.end());
    if (ended)
    {
        addLeftovers(finding.faults, place);
        if (end.exit_code == 0)
            addPackFaults(finding.faults, place, asset, programs);
        else if (end.exit_code == 65 || end.exit_code == 66)
            addRejectionFaults(finding.faults, place, asset, messages);
        else
            finding.faults.push_back("hearth cook exits with " + std::to_string(end.exit_code));
    }
    finding.outcome = getOutcome(end.exit_code, finding.faults);
    addClassFault(finding, *asset.expected);
    finding.total_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return finding;
}

std::set<std::string> traceSystemFiles(const Asset& asset, const Programs& programs, const std::string& work)
{
    const Workplace place(work);
    cook(place, asset, programs);
    return filesElsewhere(readOpenLog(place.open_log), asset.folder, place.box, programs.allowed.programs);
}

} // namespace hearth::corpus
