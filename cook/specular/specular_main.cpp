// hearth-specular: cooks the table of specular occlusion, and measures the errors of the table and the fit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/specular/astc.h"
#include "cook/specular/fit.h"
#include "cook/specular/reflectance.h"
#include "cook/specular/report.h"
#include "cook/specular/rows.h"
#include "cook/specular/sheen.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/base/regular_file.h"
#include "formats/container/container_writer.h"

#include <chrono>
#include <cstdio>

namespace
{

using namespace hearth;
using namespace hearth::specular;

struct Arguments
{
    std::string output;
    std::string rows;
    std::string report;
    std::string astc;
    std::string reflectance;
    std::string sheen;
    uint32_t astc_block = 6;
    bool fit = false;
    TableSettings settings;
    size_t configurations = 1000;
    uint64_t seed = 1;
    size_t jobs = 0;
};

Status evaluate(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(arguments.rows));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Configuration> configurations, readRows(text, arguments.rows));
    // rounded, as in a pack
    const TableValues values = unpackTable(packTable(cookTable(arguments.settings), arguments.settings));
    return writeText(arguments.output, evaluateRows(configurations, values, arguments.settings.spacing));
}

Status printFit(const Arguments& arguments)
{
    const ConstantsFit found =
        fitConstants(arguments.configurations, arguments.seed, arguments.settings.masking);
    std::printf("%zu configurations, %d iterations: rms %.5f, with the header's constants %.5f\n%s\n",
                arguments.configurations, found.iterations, found.rms, found.start_rms,
                formatConstants(found.constants).c_str());
    return success();
}

Status writePart(const Arguments& arguments, const TableValues& values)
{
    const formats::SpecularTableRecord record = packTable(values, arguments.settings);
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerWriter writer,
                            formats::ContainerWriter::create(arguments.output, formats::ContainerKind::part));
    HEARTH_TRY(writer.addRecords<formats::SpecularTableRecord>(formats::kChunkSpecular, {&record, 1}));
    return writer.finish();
}

Status writeAstc(const Arguments& arguments, const TableValues& values)
{
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(arguments.astc));
    file.write(astcFile(encodeAstc(values, arguments.astc_block)));
    return file.finish();
}

Status cook(const Arguments& arguments)
{
    const auto start = std::chrono::steady_clock::now();
    const TableValues values = cookTable(arguments.settings);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!arguments.output.empty())
        HEARTH_TRY(writePart(arguments, values));
    if (!arguments.astc.empty())
        HEARTH_TRY(writeAstc(arguments, values));
    if (arguments.report.empty())
        return success();
    const Comparison comparison = compare(arguments.settings, arguments.configurations, arguments.seed);
    if (arguments.report != "-")
        HEARTH_TRY(writeText("-", comparisonText(comparison) + "table cooked in " + std::to_string(seconds) +
                                      " s\n"));
    return writeText(arguments.report, comparisonJson(comparison, seconds));
}

Status writeReflectance(const Arguments& arguments)
{
    return writeText(arguments.reflectance,
                     formatTable(cookReflectance(), "kReflectanceTable",
                                 "// Reflection of GGX lobes: four half floats for each cosine and "
                                 "roughness. Written by\n"
                                 "// hearth-specular --reflectance; formats/gpu_shared/reflectance.h "
                                 "describes it.\n"));
}

Status writeSheen(const Arguments& arguments)
{
    return writeText(arguments.sheen,
                     formatTable(cookSheen(), "kSheenTable",
                                 "// Reflection of sheen lobes: three half floats for each cosine and "
                                 "roughness. Written by\n"
                                 "// hearth-specular --sheen; formats/gpu_shared/sheen.h describes it.\n"));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status done = !arguments.rows.empty()          ? evaluate(arguments)
                        : arguments.fit                  ? printFit(arguments)
                        : !arguments.reflectance.empty() ? writeReflectance(arguments)
                        : !arguments.sheen.empty()       ? writeSheen(arguments)
                                                         : cook(arguments);
    return done.ok() ? 0 : reportFailure(done.error());
}

/// Describe an error in the combination of options; empty if there is none.
std::string findOptionError(const Arguments& arguments)
{
    if (!(arguments.settings.normal_lambda >= 0 && arguments.settings.normal_lambda <= 1))
        return "--normal-lambda must be a number from 0 to 1";
    if (!arguments.rows.empty() && arguments.fit)
        return "--evaluate and --fit do not go together";
    if (!arguments.rows.empty() && arguments.output.empty())
        return "--evaluate needs -o";
    if (!arguments.astc.empty() && (!arguments.rows.empty() || arguments.fit))
        return "--astc goes with neither --evaluate nor --fit";
    if (arguments.rows.empty() && !arguments.fit && arguments.output.empty() && arguments.report.empty() &&
        arguments.astc.empty() && arguments.reflectance.empty() && arguments.sheen.empty())
        return "-o, --astc, --report, --fit, --reflectance or --sheen is needed";
    return {};
}

void addOptions(cli::CommandLine& app, Arguments& arguments)
{
    app.addOption("-o,--output", arguments.output, "specular part to write; with --evaluate: the CSV file");
    app.addChoice("--masking", arguments.settings.masking,
                  {{"separable", Masking::separable}, {"correlated", Masking::correlated}},
                  "Smith's masking-shadowing: separable or correlated (the default, as the runtime's BRDF)");
    app.addOption(
        "--normal-lambda", arguments.settings.normal_lambda,
        "where the table assumes the normal: 0 halves the angle of reflection vector and axis, 1 is the "
        "axis; 0.4 by default");
    app.addChoice("--spacing", arguments.settings.spacing,
                  {{"cosine", SpecularSpacing::cosine}, {"half-sine", SpecularSpacing::half_sine}},
                  "nodes between reflection vector and axis: cosine (the default) or half-sine");
    const cli::Option astc =
        app.addOption("--astc", arguments.astc, "write the table as an .astc texture of 256 x 16, too");
    app.addOption("--astc-block", arguments.astc_block,
                  "texels of its blocks along both axes: 4, 6 (the default) or 8")
        .choices(kAstcBlocks, "N")
        .needs(astc);
    app.addOption(
        "--report", arguments.report,
        "compare table, fit and what others do with the exact values: print it, and write JSON; - is "
        "standard output");
    app.addOption(
        "--evaluate", arguments.rows,
        "CSV file of aperture_rad,roughness,theta_o_rad,axis_x,axis_y,axis_z: write table,fit for each row");
    app.addOption(
        "--reflectance", arguments.reflectance,
        "write the table of specular reflectance as the header of formats/scene; - is standard output");
    app.addOption("--sheen", arguments.sheen,
                  "write the table of sheen as the header of formats/scene; - is standard output");
    app.addFlag("--fit", arguments.fit, "find the constants of the fit again and print them");
    app.addOption("--configurations", arguments.configurations,
                  "random ones, for --report and --fit; 1000 by default")
        .range(10, 1000000, "UINT");
    app.addOption("--seed", arguments.seed, "of the random configurations");
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.setFooter(
        "Example: hearth-specular -o specular.part --report specular.json\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Cooks the table of specular occlusion: how much of a GGX lobe a visibility cone lets through.");
    Arguments arguments;
    addOptions(app, arguments);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    if (const std::string fault = findOptionError(arguments); !fault.empty())
        return reportFailure({Issue::usage, "hearth-specular", "", fault});
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-specular", [&] { return program(argc, argv); });
}
