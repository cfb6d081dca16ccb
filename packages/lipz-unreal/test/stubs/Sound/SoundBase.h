#pragma once

#include "UObject/Object.h"

class USoundBase : public UObject
{
	STUB_CLASS(USoundBase, UObject)

	virtual float GetDuration() const { return StubDuration; }
	virtual bool IsLooping() const { return bStubLoops; }

	float StubDuration = 0.0f;
	bool bStubLoops = false;
};
