#pragma once

#include "Sound/SoundBase.h"

class USoundWave : public USoundBase
{
	STUB_CLASS(USoundWave, USoundBase)
};
