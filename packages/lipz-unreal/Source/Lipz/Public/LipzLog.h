#pragma once

#include "CoreMinimal.h"

/** The log of the plugin. */
LIPZ_API DECLARE_LOG_CATEGORY_EXTERN(LogLipz, Log, All);
