// hearth-import: reads a source asset and writes the import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "pipelines/import/asset_folder.h"
#include "pipelines/import/readers.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string source;
    std::string output;
};

std::string lowerCaseExtension(const std::string& path)
{
    const size_t name = path.rfind('/') + 1; // npos + 1 is 0
    const size_t dot = path.find_last_of('.');
    std::string extension = dot == std::string::npos || dot < name ? "" : path.substr(dot);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

bool looksLikeGltf(const std::string& path, std::span<const std::byte> bytes)
{
    const std::string extension = lowerCaseExtension(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return extension == ".gltf" || extension == ".glb" || text.starts_with("glTF");
}

Status readSource(const std::string& path, import::PartBuilder& part)
{
    const import::ImportOptions options;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                            import::readFile(path, options.limits.max_file_bytes));
    part.addSource(path.substr(path.rfind('/') + 1), bytes);
    if (looksLikeGltf(path, bytes))
        return importGltf(path, bytes, options, part);
    if (import::looksLikeImage(path, bytes))
        return importImage(path, bytes, options, part);
    return importScan(path, bytes, options, part);
}

void printWarnings(const import::PartBuilder& part)
{
    for (const Error& warning : part.warnings())
        std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
    if (part.warningsLeftOut() > 0)
        std::fprintf(stderr, "and %llu more warnings\n",
                     static_cast<unsigned long long>(part.warningsLeftOut()));
}

Status run(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(import::PartBuilder part,
                            import::PartBuilder::create(arguments.output, arguments.source));
    const Status read = readSource(arguments.source, part);
    printWarnings(part);
    HEARTH_TRY(read);
    return part.finish();
}

int program(int argc, char** argv)
{
    CLI::App app("Reads a glTF scene, a scan or an image and writes the import part that the cookers read.");
    Arguments arguments;
    app.add_option("source", arguments.source, "glTF, GLB, OBJ, PLY, STL, OFF, Draco or image file")
        ->required();
    app.add_option("-o,--output", arguments.output, "import part to write")->required();
    app.footer("Example: hearth-import scene.glb -o scene.import.part\n"
               "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot "
               "write, 74 I/O");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const Status status = run(arguments);
    if (status.ok())
        return 0;
    std::fprintf(stderr, "%s\n", formatMessage(import::shortened(status.error())).c_str());
    return exitCode(status.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-import", [&] { return program(argc, argv); });
}
