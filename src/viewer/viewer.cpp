#include "viewer/viewer.h"
#include "core/error.h"
namespace relievo { void run_viewer(const ViewerSettings&) { throw Error("open", "a window", "not built"); } }
