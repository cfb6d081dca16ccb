#pragma once

#include "UObject/Object.h"

class UMorphTarget : public UObject
{
	STUB_CLASS(UMorphTarget, UObject)
};
