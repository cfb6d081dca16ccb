// The importer of the editor.

#include "EditorFramework/AssetImportData.h"
#include "LipzBankFactory.h"
#include "Misc/FeedbackContext.h"
#include "Stage.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <unistd.h>

/** A file that is removed at the end. */
class FTemporaryFile
{
public:
	FTemporaryFile() { close(mkstemp(Path)); }
	~FTemporaryFile() { std::remove(Path); }
	void Write(const TArray<uint8>& Bytes, int32 Count) const
	{
		std::ofstream(Path, std::ios::binary).write(reinterpret_cast<const char*>(Bytes.GetData()), Count);
	}
	char Path[32] = "/tmp/lipz-unreal-XXXXXX";
};

void TestImports()
{
	ULipzBankFactory* Factory = NewObject<ULipzBankFactory>();
	const FTemporaryFile File;
	const FString Path = ToFString(File.Path);
	const TArray<uint8> Good = ReadFixture("drama.lipzbank");
	bool bIsCanceled = true;
	const auto Import = [&](const FString& From) {
		return Factory->FactoryCreateFile(ULipzBank::StaticClass(), nullptr, TEXT("Dialogue"), RF_Public | RF_Standalone, From, nullptr, GWarn, bIsCanceled);
	};
	EXPECT(Factory->SupportedClass == ULipzBank::StaticClass() && Factory->bEditorImport == 1);
	EXPECT_SAME(Factory->Formats[0].Utf8(), "lipzbank;lipz dialogue bank");

	File.Write(Good, Good.Num());
	ULipzBank* Bank = Cast<ULipzBank>(Import(Path));
	EXPECT(Bank != nullptr && !bIsCanceled && Bank->HasClip(TEXT("act1/mara-good-evening")) && Bank->bStubIsDirty);

	File.Write(Good, Good.Num() - 1);
	EXPECT(Import(Path) == nullptr);
	EXPECT_SAME(StubLog.back(), std::string(File.Path) + ": the file does not have the length in its header (cut off, or with bytes "
		"appended) (file 0, byte 16). Copy the file again, or pack it again.");
	EXPECT(Import(TEXT("/missing.lipzbank")) == nullptr);
	EXPECT_SAME(StubLog.back(), "/missing.lipzbank: the file cannot be read. Copy the file again, or pack it again.");

	// Importing again, from a damaged file and from a different one.
	TArray<FString> Names;
	EXPECT(Factory->CanReimport(Bank, Names) && Names.Num() == 1 && Names[0] == Path);
	EXPECT(!Factory->CanReimport(Factory, Names) && !Factory->CanReimport(nullptr, Names));
	EXPECT(Factory->Reimport(Bank) == EReimportResult::Failed);
	EXPECT(Bank->HasClip(TEXT("act1/mara-good-evening")));
	const FString Small = ToFString(Root + "/fixtures/banks/v1/small.lipzbank");
	Factory->SetReimportPaths(Bank, {Small});
	EXPECT(Factory->Reimport(Bank) == EReimportResult::Succeeded);
	EXPECT(!Bank->HasClip(TEXT("act1/mara-good-evening")) && Bank->HasClip(TEXT("act1/blair")));
	EXPECT(Factory->Reimport(nullptr) == EReimportResult::Failed);

	FString Error;
	EXPECT(ULipzBank::LoadBankFile(Small, Error) != nullptr);
	File.Write(Good, 10);
	EXPECT(ULipzBank::LoadBankFile(Path, Error) == nullptr);
	EXPECT_SAME(Error.Utf8(), "the file is shorter than the header of a bank (file 0, byte 10)");
}
