// lobe-check eval: a GLSL function, a registered model or its twin over a CSV table.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "gl/context.hpp"
#include "harness/table_evaluation.hpp"
#include "spool.hpp"
#include "watchdog.hpp"

namespace lobe::app {
namespace {

using harness::CsvReader;
using harness::CsvRow;
using harness::TableEvaluation;

struct EvalOptions {
    std::string function, file, model, inputs, output = "-", table, backend = "auto";
    bool twin = false;
    int device = -1;
    double timeLimit = 60.0;
};

EvalOptions optionsOf(CommandLine& line, const std::vector<std::string>& arguments, bool& help) {
    EvalOptions options;
    CLI::App& app = line.app();
    app.add_option("function", options.function, "function of the GLSL file");
    app.add_option("--file", options.file,
                   "GLSL file; includes are looked for beside it and in Lobe's library");
    app.add_option("--model", options.model, "registered model instead of a file: its BRDF times cosine");
    app.add_flag("--twin", options.twin, "the model's double-precision twin instead of its GLSL");
    app.add_option("--table", options.table,
                   "of models with tables: a file (.binary of MERL), or a name that comes with Lobe");
    app.add_option("--inputs", options.inputs, "CSV file; - is standard input");
    app.add_option("-o,--output", options.output, "CSV file to write; - is standard output, the default");
    app.add_option("--backend", options.backend, "auto, egl, osmesa or glfw");
    app.add_option("--device", options.device, "EGL device, as lobe info numbers them; -1 any");
    app.add_option("--time-limit", options.timeLimit, "seconds for one batch of 65536 rows (60)");
    help = !line.parse(arguments);
    if (help) return options;
    if (options.inputs.empty()) throw UsageError("no table; expected --inputs FILE.csv");
    if (options.model.empty() == options.file.empty())
        throw UsageError(std::string(options.model.empty() ? "neither" : "both") +
                         " --model and --file; expected --model NAME, or FUNCTION --file FILE");
    if (!options.file.empty() && options.function.empty())
        throw UsageError("no function; expected eval FUNCTION --file FILE");
    if (!options.model.empty() && !options.function.empty())
        throw UsageError("unexpected argument '" + options.function + "' beside --model");
    if (options.twin && options.model.empty()) throw UsageError("--twin without --model; files have none");
    if (!options.table.empty() && options.model.empty()) throw UsageError("--table without --model");
    if (!(options.timeLimit > 0.0)) throw UsageError("--time-limit: expected more than 0 seconds");
    return options;
}

std::unique_ptr<TableEvaluation> evaluationFor(const EvalOptions& options, const CsvReader& reader) {
    const harness::TableHeader header{reader.name(), reader.columns()};
    if (options.model.empty()) return harness::functionEvaluation(options.file, options.function, header);
    const Brdf& brdf = requireBrdf(options.model);
    std::optional<TableRows> table;
    if (!options.table.empty()) table = harness::tableForAllRows(brdf, options.table);
    return options.twin ? harness::twinEvaluation(brdf, header, table)
                        : harness::modelEvaluation(brdf, header, table);
}

void evaluate(const EvalOptions& options, CsvReader& reader, Spool& spool) {
    Watchdog watchdog(options.timeLimit, [&] {  // nothing has been written by then
        const std::string what =
            options.model.empty() ? options.file + ": " + options.function : options.model;
        std::fprintf(stderr, "lobe-check: error: %s: no result after %g s (--time-limit); an endless loop?\n",
                     what.c_str(), options.timeLimit);
        std::_Exit(static_cast<int>(ExitCode::checkFailed));
    });
    watchdog.start();  // compilers loop too
    const std::unique_ptr<TableEvaluation> evaluation = evaluationFor(options, reader);
    watchdog.stop();
    const auto& columns = reader.columns();
    const auto id = std::find(columns.begin(), columns.end(), "id");
    const bool hasId = id != columns.end();
    const auto idColumn = static_cast<size_t>(id - columns.begin());

    std::vector<std::string> header;
    if (hasId) header.emplace_back("id");
    for (const std::string& column : evaluation->resultColumns())
        header.push_back(column);
    std::string text;
    harness::appendRow(text, header);

    std::vector<std::string> ids;
    size_t warned = 0;
    const auto finish = [&] {
        watchdog.start();
        const std::vector<std::string> lines = evaluation->finish();
        watchdog.stop();
        for (size_t i = 0; i < lines.size(); ++i) {
            if (hasId) {
                harness::appendCell(text, ids[i]);
                text += ',';
            }
            text += lines[i];
            text += '\n';
        }
        spool.write(text);
        text.clear();
        ids.clear();
        for (; warned < evaluation->warnings().size(); ++warned)
            std::cerr << "lobe-check: warning: " << evaluation->warnings()[warned] << '\n';
    };
    for (CsvRow row; reader.next(row);) {
        evaluation->add(row);
        if (hasId) ids.push_back(std::move(row.cells[idColumn]));
        if (evaluation->isFull()) finish();
    }
    finish();
}

}  // namespace

int evalCommand(const std::vector<std::string>& arguments) {
    CommandLine line("lobe-check eval",
                     "Evaluate a GLSL function, or a registered model, over the rows of a CSV table.");
    bool help = false;
    const EvalOptions options = optionsOf(line, arguments, help);
    if (help) return 0;
    if (!options.model.empty()) requireBrdf(options.model);  // before anything is opened
    const gl::Backend backend = gl::parseBackend(options.backend);

    CsvReader reader(options.inputs);
    Spool spool;
    {
        std::unique_ptr<gl::Context> context;
        if (!options.twin) context = gl::Context::create({.backend = backend, .device = options.device});
        evaluate(options, reader, spool);
    }
    if (options.output == "-") {
        spool.copyTo(stdout, "standard output");
        return 0;
    }
    writeAtomically(options.output, [&](const std::filesystem::path& path) {
        std::FILE* target = std::fopen(path.c_str(), "wb");
        if (target == nullptr) Spool::failTarget(options.output);
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> owner(target, std::fclose);
        spool.copyTo(target, options.output);
    });
    return 0;
}

}  // namespace lobe::app
