#pragma once

#include "CoreMinimal.h"

class FTextKey
{
public:
	explicit FTextKey(const FString& InText) : Text(InText) {}
	FString Text;
};
