#include "common/app/command_line.hpp"
#include "common/app/guarded_main.hpp"
#include "modeller/fit_command.hpp"

using namespace interlace;

int main(int argc, char** argv) {
  return app::guarded_main("interlace-model", [&] {
    CLI::App cli{"Makes models of arms for cell files. `interlace-model SUBCOMMAND --help` tells more."};
    modeller::FitArguments fit;
    modeller::add_fit(cli, fit);
    cli.require_subcommand(1);
    app::add_common(cli);
    const auto code = app::parse(cli, argc, argv);
    return code ? *code : modeller::run_fit(fit);
  });
}
