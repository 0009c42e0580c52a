// What happens in the moment of a crash: the CallBoard gets a note of the signal and of the code it came from. And a
// plugin's own thread that ends with an exception is stopped alone, not the program with it.
#pragma once

namespace jet::host {

/// From now on; `ledger` is removed when somebody asks the program to end (SIGTERM, Ctrl+C): that is no crash.
void catchCrashes(const char* ledger);
/// Signals by which people end programs.
bool isPolite(int signal);

}  // namespace jet::host
