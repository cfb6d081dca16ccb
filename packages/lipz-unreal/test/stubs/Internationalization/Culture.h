#pragma once

#include "CoreMinimal.h"

class FCulture
{
public:
	const FString& GetName() const { return StubName; }
	FString StubName = TEXT("en-US");
};
