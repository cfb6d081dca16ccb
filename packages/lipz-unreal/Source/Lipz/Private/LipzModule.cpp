#include "LipzLog.h"
#include "Modules/ModuleManager.h"

DEFINE_LOG_CATEGORY(LogLipz);

IMPLEMENT_MODULE(FDefaultModuleImpl, Lipz)
