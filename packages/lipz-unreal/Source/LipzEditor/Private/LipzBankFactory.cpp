#include "LipzBankFactory.h"

#include "EditorFramework/AssetImportData.h"
#include "LipzBank.h"
#include "Misc/FeedbackContext.h"
#include "Misc/FileHelper.h"

ULipzBankFactory::ULipzBankFactory()
{
	SupportedClass = ULipzBank::StaticClass();
	bCreateNew = false;
	bEditorImport = true;
	Formats.Add(TEXT("lipzbank;lipz dialogue bank"));
}

UObject* ULipzBankFactory::FactoryCreateFile(UClass* InClass, UObject* InParent, FName InName, EObjectFlags Flags,
	const FString& Filename, const TCHAR* /*Parms*/, FFeedbackContext* Warn, bool& bOutOperationCanceled)
{
	bOutOperationCanceled = false;
	ULipzBank* Bank = NewObject<ULipzBank>(InParent, InClass, InName, Flags);
	if (Import(*Bank, Filename, *Warn))
	{
		return Bank;
	}
	Bank->ClearFlags(RF_Public | RF_Standalone); // so that the garbage collection removes it
	return nullptr;
}

bool ULipzBankFactory::CanReimport(UObject* Object, TArray<FString>& OutFilenames)
{
	const ULipzBank* Bank = Cast<ULipzBank>(Object);
	if (Bank == nullptr || Bank->AssetImportData == nullptr)
	{
		return false;
	}
	Bank->AssetImportData->ExtractFilenames(OutFilenames);
	return true;
}

void ULipzBankFactory::SetReimportPaths(UObject* Object, const TArray<FString>& NewReimportPaths)
{
	const ULipzBank* Bank = Cast<ULipzBank>(Object);
	if (Bank != nullptr && Bank->AssetImportData != nullptr && NewReimportPaths.Num() == 1)
	{
		Bank->AssetImportData->UpdateFilenameOnly(NewReimportPaths[0]);
	}
}

EReimportResult::Type ULipzBankFactory::Reimport(UObject* Object)
{
	ULipzBank* Bank = Cast<ULipzBank>(Object);
	if (Bank == nullptr || Bank->AssetImportData == nullptr)
	{
		return EReimportResult::Failed;
	}
	return Import(*Bank, Bank->AssetImportData->GetFirstFilename(), *GWarn) ? EReimportResult::Succeeded : EReimportResult::Failed;
}

bool ULipzBankFactory::Import(ULipzBank& Bank, const FString& Filename, FOutputDevice& Log)
{
	TArray<uint8> Contents;
	FString Error;
	if (!FFileHelper::LoadFileToArray(Contents, *Filename))
	{
		Error = TEXT("the file cannot be read");
	}
	else if (Bank.SetContents(Contents, Error))
	{
		if (Bank.AssetImportData == nullptr)
		{
			Bank.AssetImportData = NewObject<UAssetImportData>(&Bank);
		}
		Bank.AssetImportData->Update(Filename);
		Bank.MarkPackageDirty();
		return true;
	}
	Log.Logf(ELogVerbosity::Error, TEXT("%s: %s. Copy the file again, or pack it again."), *Filename, *Error);
	return false;
}
