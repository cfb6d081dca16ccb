#pragma once

#include "Internationalization/TextKey.h"

#include <map>

class FStringTable
{
public:
	bool GetSourceString(const FTextKey& Key, FString& Source) const
	{
		const auto Found = StubTexts.find(Key.Text.Utf8());
		if (Found != StubTexts.end()) Source = Found->second;
		return Found != StubTexts.end();
	}
	std::map<std::string, FString> StubTexts;
};
