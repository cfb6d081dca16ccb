#pragma once

#include "CoreMinimal.h"

class FFeedbackContext : public FOutputDevice
{
};
extern FFeedbackContext* GWarn;
