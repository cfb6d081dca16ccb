#include "LipzStrings.h"

namespace LipzStrings
{
	FString ToFString(const lipz_string& String)
	{
		if (String.data == nullptr || String.length_bytes == 0)
		{
			return FString();
		}
		const FUTF8ToTCHAR Converted(String.data, static_cast<int32>(String.length_bytes));
		return FString(FStringView(Converted.Get(), Converted.Length()));
	}

	FName ToFName(const lipz_string& String)
	{
		const FString Name = ToFString(String);
		return Name.Len() < NAME_SIZE ? FName(*Name) : FName();
	}

	FString Message(lipz_status Status)
	{
		lipz_string Sentence;
		lipz_status_message(Status, &Sentence);
		return ToFString(Sentence);
	}
}
