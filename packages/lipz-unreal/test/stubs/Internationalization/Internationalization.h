#pragma once

#include "CoreMinimal.h"

class FCulture;

class FInternationalization
{
public:
	static FInternationalization& Get();
	TSharedRef<FCulture> GetCurrentLanguage() const { return StubLanguage; }
	TSharedRef<FCulture> StubLanguage;
};
