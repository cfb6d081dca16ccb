#pragma once

#include "UObject/Object.h"

class UAssetImportData : public UObject
{
	STUB_CLASS(UAssetImportData, UObject)

	void Update(const FString& Filename) { StubFilename = Filename; }
	void UpdateFilenameOnly(const FString& Filename) { StubFilename = Filename; }
	FString GetFirstFilename() const { return StubFilename; }
	void ExtractFilenames(TArray<FString>& Filenames) const { Filenames.Add(StubFilename); }

	FString StubFilename;
};
