/// The commands of lobe; each takes the arguments after its name and returns the exit code.
#pragma once

#include <string>
#include <vector>

namespace lobe::app {

int renderCommand(const std::vector<std::string>& arguments);
/// `lobe reference SCENE`: docs/reference.md.
int referenceCommand(const std::vector<std::string>& arguments);
/// `lobe explain SCENE --pixel X,Y`: docs/explain.md.
int explainCommand(const std::vector<std::string>& arguments);
int planCommand(const std::vector<std::string>& arguments);
/// `lobe plot KIND`: docs/plots.md.
int plotCommand(const std::vector<std::string>& arguments);
/// `lobe report`: docs/report.md.
int reportCommand(const std::vector<std::string>& arguments);
/// `lobe bake ENV`: docs/environment.md.
int bakeCommand(const std::vector<std::string>& arguments);
/// `lobe compare A B`: docs/compare.md.
int compareCommand(const std::vector<std::string>& arguments);
int infoCommand(const std::vector<std::string>& arguments);
int modelsCommand(const std::vector<std::string>& arguments);
/// `lobe help [--markdown]`: all settings, as docs/cli.md holds them.
int helpCommand(const std::vector<std::string>& arguments);

}  // namespace lobe::app
