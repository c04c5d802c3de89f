// vispline: read | verb | write. Errors end here, as an exit code and a text that says what to do next.
#include <iostream>

#include "console.h"
#include "verbs.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 2 usage, 3 input unreadable, 4 input unfit, 5 no trustworthy result, 6 output failed,\n"
    "            7 limit hit, 130/143 interrupted.\n"
    "Examples:\n"
    "  vispline demo --out out/demo\n"
    "  vispline simulate --trajectory dance --imu-rate 200 --noise course --out imu.csv\n"
    "  vispline simulate --trajectory mocap.csv --like imu.csv --out synth.csv\n"
    "  vispline evaluate synth.csv imu.csv\n"
    "  vispline integrate --trajectory ellipse --imu-rate 50,100,200 --method all";

int run(int argc, char** argv) {
  CLI::App app("Simulate, identify, integrate and estimate with cameras and IMUs.", "vispline");
  app.set_version_flag("--version", "vispline " VISPLINE_VERSION);
  app.footer(kFooter);
  app.require_subcommand(0, 1);
  vispline::cli::add_simulate(app);
  vispline::cli::add_integrate(app);
  vispline::cli::add_evaluate(app);
  vispline::cli::add_demo(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) std::cout << app.help();
    return 0;
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return static_cast<int>(vispline::ExitCode::kUsage);
  }
}

}  // namespace

int main(int argc, char** argv) {
  vispline::cli::catch_interrupts();
  try {
    return run(argc, argv);
  } catch (const vispline::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.exit_code());
  } catch (const vispline::cli::Interrupted& interrupted) {
    std::cerr << "error[E-INTERRUPTED]: stopped by signal " << interrupted.signal << "\n  effect: nothing written\n";
    return 128 + interrupted.signal;
  } catch (const std::bad_alloc&) {
    std::cerr << "error[E-LIMIT]: out of memory\n  effect: nothing written\n";
    return static_cast<int>(vispline::ExitCode::kLimit);
  }
}
